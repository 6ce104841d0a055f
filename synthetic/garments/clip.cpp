#include "synthetic/garments/clip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace dressform {
namespace {

// A vertex nearer to the zero than this part of a crossed edge is moved onto it.
constexpr double kSnap = 0.18;

void snap_to_zero(Mesh& mesh, std::vector<double>& value) {
  std::vector<double> best(value.size(), kSnap);
  std::vector<int> toward(value.size(), -1);
  for (const Vector3i& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (value[a] * value[b] >= 0) continue;
      const double from_a = value[a] / (value[a] - value[b]);
      if (from_a < best[a]) best[a] = from_a, toward[a] = b;
      if (1 - from_a < best[b]) best[b] = 1 - from_a, toward[b] = a;
    }
  const std::vector<Vector3d> before = mesh.vertices;
  for (size_t i = 0; i < value.size(); ++i)
    if (toward[i] >= 0) {
      mesh.vertices[i] = before[i] + best[i] * (before[toward[i]] - before[i]);
      value[i] = 0;
    }
}

class Splitter {
 public:
  Splitter(Mesh& mesh, std::vector<double>& value) : mesh_(mesh), value_(value) {}

  void run() {
    std::vector<Vector3i> triangles;
    for (const Vector3i& t : mesh_.triangles) split(t, triangles);
    mesh_.triangles = std::move(triangles);
  }

 private:
  int cut(int a, int b) {
    const auto [found, is_new] = cuts_.emplace(std::minmax(a, b), static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      const auto [low, high] = std::minmax(a, b);
      const double t = value_[low] / (value_[low] - value_[high]);
      mesh_.vertices.push_back(mesh_.vertices[low] + t * (mesh_.vertices[high] - mesh_.vertices[low]));
      value_.push_back(0);
    }
    return found->second;
  }

  void split(const Vector3i& t, std::vector<Vector3i>& out) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (value_[a] == 0 && value_[b] * value_[c] < 0) {  // through a corner
        const int m = cut(b, c);
        out.emplace_back(a, b, m);
        out.emplace_back(a, m, c);
        return;
      }
      if (value_[a] * value_[b] < 0 && value_[a] * value_[c] < 0) {  // a alone on its side
        const int ab = cut(a, b), ac = cut(a, c);
        out.emplace_back(a, ab, ac);
        const bool first =
            (mesh_.vertices[ab] - mesh_.vertices[c]).norm() <= (mesh_.vertices[ac] - mesh_.vertices[b]).norm();
        if (first) {
          out.emplace_back(ab, b, c);
          out.emplace_back(ab, c, ac);
        } else {
          out.emplace_back(ab, b, ac);
          out.emplace_back(b, c, ac);
        }
        return;
      }
    }
    out.push_back(t);
  }

  Mesh& mesh_;
  std::vector<double>& value_;
  std::map<std::pair<int, int>, int> cuts_;
};

}  // namespace

std::vector<double> split_along(Mesh& mesh, const Level& level) {
  std::vector<double> value;
  value.reserve(mesh.vertices.size());
  for (const Vector3d& v : mesh.vertices) value.push_back(level(v));
  snap_to_zero(mesh, value);
  Splitter(mesh, value).run();
  return value;
}

Mesh cut_off(Mesh mesh, const Level& level) {
  const std::vector<double> value = split_along(mesh, level);
  Mesh result;
  result.vertices = mesh.vertices;
  for (const Vector3i& t : mesh.triangles)
    if (std::max({value[t[0]], value[t[1]], value[t[2]]}) <= 0 && std::min({value[t[0]], value[t[1]], value[t[2]]}) < 0)
      result.triangles.push_back(t);
  return compacted(result);
}

Mesh largest_part(const Mesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Vector3i& t : mesh.triangles)
    for (int k = 1; k < 3; ++k) parent[root(t[k])] = root(t[0]);
  std::vector<int> size(mesh.vertices.size(), 0);
  for (const Vector3i& t : mesh.triangles) ++size[root(t[0])];
  const int keep = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  Mesh result;
  result.vertices = mesh.vertices;
  for (const Vector3i& t : mesh.triangles)
    if (root(t[0]) == keep) result.triangles.push_back(t);
  return compacted(result);
}

}  // namespace dressform
