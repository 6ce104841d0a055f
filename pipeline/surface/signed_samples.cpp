#include "pipeline/surface/signed_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "pipeline/geometry/biharmonic_field.h"
#include "pipeline/geometry/point_tree.h"

namespace dressform {
namespace {

constexpr int kFewestCentres = 8;  // a linear part takes four; fewer than twice that is no surface

using Cell = std::array<long, 3>;
Cell cell_of(const Vector3d& point, double size_m) {
  const Vector3d cell = (point / size_m).array().floor();
  return {std::lround(cell.x()), std::lround(cell.y()), std::lround(cell.z())};
}

// Missed samples, worst first, no two of a cell.
std::vector<std::size_t> worst_missed(const SignedSamples& samples, const std::vector<double>& found,
                                      const std::vector<char>& taken, const GreedyFit& fit, std::size_t most) {
  std::vector<std::size_t> missed;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!taken[i] && std::abs(found[i] - samples.distances_m[i]) > fit.tolerance_m) missed.push_back(i);
  std::stable_sort(missed.begin(), missed.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(found[a] - samples.distances_m[a]) > std::abs(found[b] - samples.distances_m[b]);
  });
  std::set<Cell> cells;
  std::vector<std::size_t> worst;
  for (const std::size_t i : missed) {
    if (worst.size() >= most) break;
    if (cells.insert(cell_of(samples.points[i], fit.apart_m)).second) worst.push_back(i);
  }
  return worst;
}

}  // namespace

SignedSamples signed_samples(const PointCloud& cloud, double offset_m, double nearest_m, int every) {
  SignedSamples samples;
  samples.points = cloud.points;
  samples.distances_m.assign(cloud.points.size(), 0);
  if (cloud.points.empty()) return samples;
  const PointTree tree(cloud.points);
  for (std::size_t i = 0; i < cloud.points.size(); i += static_cast<std::size_t>(every))
    for (const double side : {1.0, -1.0})
      for (double away_m = offset_m; away_m >= nearest_m; away_m /= 2) {
        const Vector3d point = cloud.points[i] + side * away_m * cloud.normals[i];
        std::uint32_t nearest = 0;
        double squared = 0;
        if (!tree.nearest(point, nearest, squared) || nearest != i) continue;
        samples.points.push_back(point);
        samples.distances_m.push_back(side * away_m);
        break;
      }
  return samples;
}

std::vector<std::size_t> greedy_centres(const SignedSamples& samples, const GreedyFit& fit) {
  const std::size_t count = samples.points.size();
  std::vector<std::size_t> centres;
  std::vector<char> taken(count, 0);
  std::set<Cell> places;  // centres at one place to a tenth of a millimetre make the system singular
  const auto take = [&](std::size_t i) {
    constexpr double kSame_m = 1e-4;
    taken[i] = 1;
    if (places.insert(cell_of(samples.points[i], kSame_m)).second) centres.push_back(i);
  };
  const std::size_t stride = std::max<std::size_t>(1, count / std::max(1, fit.first_centres));
  for (std::size_t i = 0; i < count; i += stride) take(i);
  if (static_cast<int>(centres.size()) < kFewestCentres) return {};
  while (static_cast<int>(centres.size()) < fit.most_centres) {
    std::vector<Vector3d> points;
    std::vector<double> values;
    for (const std::size_t i : centres) {
      points.push_back(samples.points[i]);
      values.push_back(samples.distances_m[i]);
    }
    const BiharmonicField field(std::move(points), values, fit.smoothing_m);
    const auto room = static_cast<std::size_t>(fit.most_centres) - centres.size();
    const auto most = std::min(room, 1 + static_cast<std::size_t>(fit.growth * static_cast<double>(centres.size())));
    const auto worst = worst_missed(samples, field(samples.points), taken, fit, most);
    if (worst.empty()) break;
    for (const std::size_t i : worst) take(i);
  }
  return centres;
}

}  // namespace dressform
