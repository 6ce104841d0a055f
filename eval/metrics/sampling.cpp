#include "eval/metrics/sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/random.h"
#include "scenes/triangle.h"

namespace dressform::metrics {
namespace {

double pairwise_sum(const double* values, std::size_t count) {
  if (count > 64) return pairwise_sum(values, count / 2) + pairwise_sum(values + count / 2, count - count / 2);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i];
  return sum;
}

}  // namespace

double surface_area(const Mesh& mesh) {
  double area = 0;
  for (const auto& triangle : mesh.triangles) area += triangle_area_m2(mesh, triangle);
  return area;
}

SurfaceSamples sample_surface(const Mesh& mesh, double spacing_m, std::uint64_t seed) {
  SurfaceSamples samples;
  const double area = surface_area(mesh);
  if (!(area > 0)) return samples;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(area / (spacing_m * spacing_m) - 1e-6)));
  samples.points.reserve(count);
  samples.triangles.reserve(count);
  samples.nearest_vertices.reserve(count);
  double passed = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    passed += triangle_area_m2(mesh, t);
    const bool last = i + 1 == mesh.triangles.size();
    while (next < count) {
      const auto u = uniform4(seed, stream_of("surface samples"), next);
      if (!last && (static_cast<double>(next) + u[0]) / static_cast<double>(count) * area >= passed) break;
      const double root = std::sqrt(u[1]);  // Turk, Graphics Gems, 1990
      const Vector3d weights(1 - root, root * (1 - u[2]), root * u[2]);
      int nearest = 0;
      weights.maxCoeff(&nearest);
      samples.points.push_back(weights[0] * mesh.vertices[t[0]] + weights[1] * mesh.vertices[t[1]] +
                               weights[2] * mesh.vertices[t[2]]);
      samples.triangles.push_back(static_cast<int>(i));
      samples.nearest_vertices.push_back(t[nearest]);
      ++next;
    }
  }
  return samples;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[below];
  if (below + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (place - static_cast<double>(below)) * (high - low);
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return pairwise_sum(values.data(), values.size()) / static_cast<double>(values.size());
}

}  // namespace dressform::metrics
