#include "eval/metrics/fit_metrics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/sampling.h"

namespace dressform::metrics {
namespace {

// One vertex of every component.
std::vector<int> representatives(const Mesh& mesh) {
  std::vector<int> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 2; ++k) {
      const int a = find(t[k]), b = find(t[k + 1]);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::set<int> result;
  for (const auto& t : mesh.triangles) result.insert(find(t[0]));
  return {result.begin(), result.end()};
}

// Tells on which side of a closed mesh a point lies from what lies nearest to it, by the angle-weighted pseudonormal of
// that face, side or corner (Baerentzen and Aanaes, 2005): the winding number's answer, at the cost of one product.
class Side {
 public:
  explicit Side(const Mesh& mesh) : mesh_(mesh), corners_(mesh.vertices.size(), Vector3d::Zero()) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vector3i& t = mesh.triangles[i];
      const Vector3d normal = triangle_normal(mesh, static_cast<int>(i));
      for (int k = 0; k < 3; ++k) {
        const Vector3d u = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
        const Vector3d w = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
        corners_[t[k]] += std::atan2(u.cross(w).norm(), u.dot(w)) * normal;
        sides_.push_back({std::minmax(t[k], t[(k + 1) % 3]), normal});
      }
    }
    std::sort(sides_.begin(), sides_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  bool inside(const Vector3d& point, const NearestOnMesh& nearest) const {
    const Vector3i& t = mesh_.triangles[nearest.triangle];
    Vector3d foot = Vector3d::Zero();
    int on = 0, first = -1, second = -1;  // corners with weight
    for (int k = 0; k < 3; ++k) {
      foot += nearest.weights[k] * mesh_.vertices[t[k]];
      if (nearest.weights[k] <= kOnSide) continue;
      ++on;
      (first < 0 ? first : second) = t[k];
    }
    const Vector3d normal = on == 3 ? triangle_normal(mesh_, nearest.triangle)
                                    : (on == 2 ? of_side(std::minmax(first, second)) : corners_[first]);
    return normal.dot(point - foot) < 0;
  }

 private:
  static constexpr double kOnSide = 1e-9;

  Vector3d of_side(const std::pair<int, int>& side) const {
    Vector3d sum = Vector3d::Zero();
    auto at =
        std::lower_bound(sides_.begin(), sides_.end(), side, [](const auto& a, const auto& b) { return a.first < b; });
    for (; at != sides_.end() && at->first == side; ++at) sum += at->second;
    return sum;
  }

  const Mesh& mesh_;
  std::vector<Vector3d> corners_;
  std::vector<std::pair<std::pair<int, int>, Vector3d>> sides_;
};

}  // namespace

Penetration penetration(const Mesh& garment, const Mesh& body, double spacing_m, std::uint64_t seed) {
  const SurfaceSamples samples = sample_surface(garment, spacing_m, seed);
  const auto nearest = MeshDistance(body).nearest(samples.points);
  std::vector<double> depths(samples.points.size());
  const Side side(body);
  for (std::size_t i = 0; i < depths.size(); ++i)
    depths[i] = side.inside(samples.points[i], nearest[i]) ? nearest[i].distance_m * 1000 : 0;
  Penetration result;
  result.samples = static_cast<long>(depths.size());
  const auto deep = std::count_if(depths.begin(), depths.end(), [](double depth) { return depth > 1; });
  result.area_cm2 = surface_area(garment) * 1e4 * static_cast<double>(deep) / static_cast<double>(depths.size());
  result.mean_mm = mean(depths);
  result.p95_mm = quantile(depths, 0.95);
  result.max_mm = quantile(depths, 1);
  for (const int vertex : representatives(garment))
    result.components_inside += winding_number(body, garment.vertices[vertex]) > 0.5;
  return result;
}

double edge_stretch_p95(const Mesh& before, const Mesh& after) {
  if (before.triangles != after.triangles || before.vertices.size() != after.vertices.size())
    throw std::invalid_argument("edge_stretch_p95: the triangles differ");
  std::vector<std::pair<int, int>> edges;
  for (const auto& t : before.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<double> stretch;
  for (const auto& [a, b] : edges) {
    const double length = (before.vertices[a] - before.vertices[b]).norm();
    if (length > 1e-6) stretch.push_back(std::abs((after.vertices[a] - after.vertices[b]).norm() / length - 1));
  }
  return quantile(stretch, 0.95);
}

}  // namespace dressform::metrics
