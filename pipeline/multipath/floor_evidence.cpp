#include "pipeline/multipath/floor_evidence.h"

#include <algorithm>
#include <cmath>

#include "pipeline/geometry/floor.h"
#include "scenes/random.h"
#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr Seed kFloorSeed = 20;    // of the search's draws; another seed finds the same plane
constexpr int kLeastCells = 80;    // of the floor, for its bend to be told from its tilt
constexpr double kTilt_deg = 30;   // of the floor against the sensor's horizon
constexpr double kLevel = 0.75;    // cosine from which a cell faces up by that horizon: tilted by 30 degrees, and noisy
constexpr double kOnFloor = 0.85;  // the same by the floor's own normal
constexpr double kTukey = 4;       // sigmas beyond which a cell says nothing
constexpr int kIterations = 15;    // of reweighting
constexpr double kLeastSigma = 1e-9;  // of a floor without any noise
constexpr double kBand = 0.05;        // metres from the plane
constexpr double kFar = 3.2;          // metres: farther floors are lit by walls beyond the sensor's reach

Vector3d point_of(const SurfaceCells& cells, int i) { return Vector3d(cells.x[i], cells.y[i], cells.z[i]); }
Vector3d normal_of(const SurfaceCells& cells, int i) {
  return Vector3d(cells.normal_x[i], cells.normal_y[i], cells.normal_z[i]);
}

std::vector<char> floor_cells(const SurfaceCells& cells) {
  FloorSearch search;
  search.tilt_deg = kTilt_deg;
  search.least_inliers = kLeastCells;
  std::vector<Vector3d> level;
  for (int i = 0; i < cells.count(); ++i)
    if (cells.z[i] > 0 && normal_of(cells, i).dot(search.up) > kLevel) level.push_back(point_of(cells, i));
  const auto plane = find_floor(level, search, kFloorSeed, stream_of("multipath.floor"));
  std::vector<char> result(cells.count(), 0);
  if (!plane) return result;
  for (int i = 0; i < cells.count(); ++i)
    result[i] = cells.z[i] > 0 && cells.z[i] < kFar && normal_of(cells, i).dot(plane->head<3>()) > kOnFloor &&
                std::abs(plane->head<3>().dot(point_of(cells, i)) + (*plane)[3]) < kBand;
  return result;
}

}  // namespace

// A plane is linear in inverse depth, 1/z = n.(ray), and an error e of depth adds -e/z^2.
FloorEvidence floor_evidence(const SurfaceCells& cells, const std::vector<float>& errors_m) {
  FloorEvidence result;
  result.is_floor = floor_cells(cells);
  const auto count = std::count(result.is_floor.begin(), result.is_floor.end(), 1);
  if (count < kLeastCells) return result;
  Eigen::MatrixX4d equations(count, 4);
  Eigen::VectorXd right(count), weights = Eigen::VectorXd::Ones(count);
  int row = 0;
  for (int i = 0; i < cells.count(); ++i) {
    if (!result.is_floor[i]) continue;
    const double z = cells.z[i], scale = std::sqrt(z);  // of 1/z over its noise, which grows as z^1.5
    equations.row(row) << scale * cells.x[i] / z, scale * cells.y[i] / z, scale, -scale * errors_m[i] / (z * z);
    right[row++] = scale / z;
  }
  Eigen::Matrix4d normal;
  double sigma = 0;
  Eigen::Vector4d solution = Eigen::Vector4d::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    normal = equations.transpose() * weights.asDiagonal() * equations;
    solution = solve_symmetric(normal, equations.transpose() * weights.cwiseProduct(right));
    const Eigen::VectorXd residual = (equations * solution - right).cwiseAbs();
    sigma = std::max(kLeastSigma, kSigmaPerMedianDeviation * median<double>({residual.begin(), residual.end()}));
    weights = residual.unaryExpr(
        [&](double r) { return Tukey::of_square(r * r / (kTukey * kTukey * sigma * sigma)).weight; });
  }
  result.factor = solution[3];
  result.sigma = sigma * std::sqrt(normal.inverse()(3, 3));
  result.found = std::isfinite(result.factor) && std::isfinite(result.sigma);
  return result;
}

}  // namespace dressform
