#include "eval/score/rigid_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/sampling.h"
#include "scenes/small_solvers.h"

namespace dressform {
namespace {
using namespace metrics;

constexpr double kKeptPart = 0.9;      // of the points: holes and flaps of either do not pull
constexpr double kAlongWeight = 0.05;  // of distances along the surface, beside those across it: rims fix what slides
constexpr std::size_t kCoarsePoints = 250, kFinePoints = 1500;
constexpr int kCoarseSteps = 15, kFineSteps = 60, kRefinedStarts = 3;
constexpr double kStill = 1e-6;  // relative gain of a step below which it has come to rest

std::vector<Vector3d> about(std::size_t count, const Mesh& mesh) {
  return sample_surface(mesh, std::sqrt(surface_area(mesh) / static_cast<double>(count)), 1).points;
}

Vector3d centre_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

struct Fit {
  Isometry3d truth_from_estimate = Isometry3d::Identity();
  double rms_m = std::numeric_limits<double>::infinity();
};

// The nearer points, moved, with the nearest places of the truth and its normals there.
struct Pairs {
  std::vector<Vector3d> points, places, normals;
  double rms_m = 0;
};

Pairs nearer_pairs(const std::vector<Vector3d>& points, const MeshDistance& truth, const Isometry3d& motion) {
  std::vector<Vector3d> moved;
  for (const auto& point : points) moved.push_back(motion * point);
  const auto nearest = truth.nearest(moved);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return nearest[a].distance_m < nearest[b].distance_m; });
  order.resize(static_cast<std::size_t>(std::ceil(kKeptPart * static_cast<double>(order.size()))));
  Pairs pairs;
  for (const std::size_t i : order) {
    const Vector3i& t = truth.mesh().triangles[nearest[i].triangle];
    Vector3d place = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) place += nearest[i].weights[k] * truth.mesh().vertices[t[k]];
    pairs.points.push_back(moved[i]);
    pairs.places.push_back(place);
    pairs.normals.push_back(triangle_normal(truth.mesh(), nearest[i].triangle));
    pairs.rms_m += nearest[i].distance_m * nearest[i].distance_m;
  }
  pairs.rms_m = std::sqrt(pairs.rms_m / static_cast<double>(order.size()));
  return pairs;
}

// The small motion that brings the points to their places: linearised about the points' centre, distances across the
// surface in full, those along it by kAlongWeight.
Isometry3d small_motion(const Pairs& pairs) {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  const Vector3d centre = centre_of(pairs.points);
  Matrix6d equations = 1e-12 * Matrix6d::Identity();
  Vector6d right = Vector6d::Zero();
  for (std::size_t i = 0; i < pairs.points.size(); ++i) {
    const Vector3d arm = pairs.points[i] - centre, step = pairs.places[i] - pairs.points[i];
    for (int k = 0; k < 4; ++k) {
      const Vector3d axis = k < 3 ? Vector3d(Vector3d::Unit(k)) : pairs.normals[i];
      Vector6d row;
      row << arm.cross(axis), axis;
      const double weight = k < 3 ? kAlongWeight : 1;
      equations += weight * row * row.transpose();
      right += weight * axis.dot(step) * row;
    }
  }
  const Vector6d solved = solve_symmetric(equations, right);
  const Vector3d turn = solved.head<3>();
  Isometry3d motion = Isometry3d::Identity();
  if (turn.norm() > 0) motion.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  motion.translation() = centre + solved.tail<3>() - motion.linear() * centre;
  return motion;
}

// The best of the motions that the steps pass through.
Fit refined(const std::vector<Vector3d>& points, const MeshDistance& truth, Fit fit, int steps) {
  fit.rms_m = std::numeric_limits<double>::infinity();
  Isometry3d motion = fit.truth_from_estimate;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i) {
    const Pairs pairs = nearer_pairs(points, truth, motion);
    if (pairs.rms_m < fit.rms_m) fit = {motion, pairs.rms_m};
    if (std::abs(before - pairs.rms_m) <= kStill * pairs.rms_m) break;
    before = pairs.rms_m;
    motion = small_motion(pairs) * motion;
  }
  return fit;
}

// Every turn that brings axes onto axes, and the headings between.
std::vector<Eigen::Matrix3d> start_turns() {
  std::vector<Eigen::Matrix3d> turns;
  for (int heading = 0; heading < 8; ++heading)
    turns.push_back(Eigen::AngleAxisd(heading * M_PI / 4, Vector3d::UnitY()).toRotationMatrix());
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (const double sx : {1.0, -1.0})
        for (const double sy : {1.0, -1.0}) {
          if (x == y || (y == 1 && sy > 0)) continue;  // y stays up: among the headings
          Eigen::Matrix3d turn;
          turn.col(0) = sx * Vector3d::Unit(x);
          turn.col(1) = sy * Vector3d::Unit(y);
          turn.col(2) = turn.col(0).cross(turn.col(1));
          turns.push_back(turn);
        }
  return turns;
}

}  // namespace

Isometry3d best_rigid_motion(const Mesh& estimate, const Mesh& truth) {
  const MeshDistance distance(truth);
  const auto coarse = about(kCoarsePoints, estimate), fine = about(kFinePoints, estimate);
  const Vector3d estimate_centre = centre_of(coarse), truth_centre = centre_of(about(kCoarsePoints, truth));
  const auto turns = start_turns();
  std::vector<Fit> fits(turns.size());
  tbb::parallel_for(std::size_t{0}, turns.size(), [&](std::size_t i) {
    fits[i].truth_from_estimate.linear() = turns[i];
    fits[i].truth_from_estimate.translation() = truth_centre - turns[i] * estimate_centre;
    fits[i] = refined(coarse, distance, fits[i], kCoarseSteps);
  });
  std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.rms_m < b.rms_m; });
  Fit best;
  for (int i = 0; i < kRefinedStarts; ++i) {
    const Fit fit = refined(fine, distance, fits[i], kFineSteps);
    if (fit.rms_m < best.rms_m) best = fit;
  }
  return best.truth_from_estimate;
}

}  // namespace dressform
