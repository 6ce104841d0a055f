#include "synthetic/garments/drape/cloth.h"

#include <algorithm>
#include <cmath>

#include "scenes/statistics.h"

namespace dressform {
namespace {

std::vector<double> rest_lengths(const Mesh& cut, const Features& features, const Fullness& fullness) {
  std::vector<double> rest;
  rest.reserve(features.edges.size());
  for (const auto& e : features.edges) {
    const Vector3d &a = cut.vertices[e[0]], &b = cut.vertices[e[1]];
    rest.push_back((fullness(0.5 * (a + b)) * (b - a)).norm());
  }
  return rest;
}

// A halved edge bends as the whole one did, one inside of a triangle as the stiffest of that triangle's.
std::vector<double> halved_bending(const Cloth& cloth, const Features& fine) {
  std::vector<double> parts;
  const int corners = static_cast<int>(cloth.mesh.vertices.size());
  for (const auto& e : fine.edges) {  // e[0] < e[1]: the second is the middle of an edge
    const double second = cloth.bending[e[1] - corners];
    parts.push_back(e[0] < corners ? second : std::max(cloth.bending[e[0] - corners], second));
  }
  return parts;
}

}  // namespace

Cloth cloth_as_cut(const Mesh& mesh, const Fullness& fullness, const std::function<bool(const Vector3d&)>& held) {
  Cloth cloth;
  cloth.mesh = mesh;
  cloth.features = features_of(mesh.triangles);
  cloth.rest_m = rest_lengths(mesh, cloth.features, fullness);
  for (const Vector3d& v : mesh.vertices) cloth.held.push_back(held(v));
  return cloth;
}

Mesh subdivided(const Mesh& mesh, const Features& features) {
  Mesh fine;
  fine.vertices = mesh.vertices;
  for (const auto& e : features.edges) fine.vertices.push_back(0.5 * (mesh.vertices[e[0]] + mesh.vertices[e[1]]));
  const auto middle = [&](int a, int b) {
    if (a > b) std::swap(a, b);
    const auto less = [](const Eigen::Vector2i& x, const std::pair<int, int>& y) { return std::pair(x[0], x[1]) < y; };
    const auto at = std::lower_bound(features.edges.begin(), features.edges.end(), std::pair(a, b), less);
    return static_cast<int>(mesh.vertices.size() + (at - features.edges.begin()));
  };
  for (const Vector3i& t : mesh.triangles) {
    const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    fine.triangles.emplace_back(t[0], ab, ca);
    fine.triangles.emplace_back(ab, t[1], bc);
    fine.triangles.emplace_back(ca, bc, t[2]);
    fine.triangles.emplace_back(ab, bc, ca);
  }
  return fine;
}

Cloth halved(const Cloth& cloth, const Mesh& cut, const Fullness& fullness) {
  Cloth fine;
  fine.mesh = subdivided(cloth.mesh, cloth.features);
  fine.features = features_of(fine.mesh.triangles);
  fine.rest_m = rest_lengths(subdivided(cut, cloth.features), fine.features, fullness);
  if (!cloth.bending.empty()) fine.bending = halved_bending(cloth, fine.features);
  fine.held = cloth.held;
  for (const auto& e : cloth.features.edges) fine.held.push_back(cloth.held[e[0]] && cloth.held[e[1]]);
  return fine;
}

double strain_quantile(const Cloth& cloth, const std::vector<Vector3d>& vertices, double part) {
  std::vector<double> strain;
  for (size_t i = 0; i < cloth.rest_m.size(); ++i) {
    const auto& e = cloth.features.edges[i];
    strain.push_back(std::abs((vertices[e[0]] - vertices[e[1]]).norm() / cloth.rest_m[i] - 1));
  }
  return strain.empty() ? 0 : lower_quantile(std::move(strain), part);
}

}  // namespace dressform
