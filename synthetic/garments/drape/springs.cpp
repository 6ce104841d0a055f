#include "synthetic/garments/drape/springs.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kLattice = 0.87;  // sqrt(3) / 2: a spring of a triangular lattice over the stiffness of its cloth

double triangle_area(double a, double b, double c) {
  const double s = 0.5 * (a + b + c);
  return std::sqrt(std::max(1e-16, s * (s - a) * (s - b) * (s - c)));
}

// Cotangent of the angle opposite to `a` in a triangle with these sides.
double cotangent(double a, double b, double c) {
  return std::clamp((b * b + c * c - a * a) / (4 * triangle_area(a, b, c)), -10.0, 10.0);
}

size_t edge_number(const Cloth& cloth, int a, int b) {
  if (a > b) std::swap(a, b);
  const auto less = [](const Eigen::Vector2i& x, const std::pair<int, int>& y) { return std::pair(x[0], x[1]) < y; };
  const auto& edges = cloth.features.edges;
  return std::lower_bound(edges.begin(), edges.end(), std::pair(a, b), less) - edges.begin();
}
double rest_length(const Cloth& cloth, int a, int b) { return cloth.rest_m[edge_number(cloth, a, b)]; }
double bending_part(const Cloth& cloth, int a, int b) {
  return cloth.bending.empty() ? 1 : cloth.bending[edge_number(cloth, a, b)];
}

}  // namespace

std::vector<double> lightness_of(const Cloth& cloth) {
  const std::size_t count = cloth.mesh.vertices.size();
  std::vector<double> mass(count, 0), lightness(count, 0);
  for (const Vector3i& t : cloth.mesh.triangles) {
    const double area =
        triangle_area(rest_length(cloth, t[0], t[1]), rest_length(cloth, t[1], t[2]), rest_length(cloth, t[2], t[0]));
    for (int k = 0; k < 3; ++k) mass[t[k]] += area / 3;
  }
  for (std::size_t i = 0; i < count; ++i) lightness[i] = cloth.held[i] || mass[i] == 0 ? 0 : 1 / mass[i];
  return lightness;
}

std::vector<Spring> springs_of(const Cloth& cloth, const DrapeParams& params, const std::vector<double>& lightness) {
  std::vector<Spring> springs;
  const auto& x = cloth.mesh.vertices;
  const double stiffness = kGravity / params.stretch_per_m;  // N/m per kg/m^2
  for (size_t i = 0; i < cloth.rest_m.size(); ++i) {
    const auto& e = cloth.features.edges[i];
    if (lightness[e[0]] + lightness[e[1]] == 0) continue;
    // A spring of a triangular lattice of that stiffness.
    springs.push_back({e[0], e[1], (x[e[0]] - x[e[1]]).norm(), cloth.rest_m[i], 1 / (kLattice * stiffness)});
  }
  // Gravity's way: a sweep from the top down carries the weight further than one in no order.
  std::stable_sort(springs.begin(), springs.end(),
                   [&](const Spring& p, const Spring& q) { return x[p.a].y() + x[p.b].y() > x[q.a].y() + x[q.b].y(); });
  return springs;
}

std::vector<Hinge> hinges_of(const Cloth& cloth, const DrapeParams& params) {
  std::vector<Hinge> hinges;
  const double stiffness = kGravity * std::pow(params.bending_length_m, 3);  // N m per kg/m^2
  std::vector<std::array<int, 4>> sides;                                     // (low, high, opposite, order)
  for (const Vector3i& t : cloth.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      sides.push_back({low, high, t[(k + 2) % 3], static_cast<int>(sides.size())});
    }
  std::sort(sides.begin(), sides.end());
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    const auto &s = sides[i], &t = sides[i + 1];
    if (s[0] != t[0] || s[1] != t[1]) continue;
    const int a = s[0], b = s[1], c = s[2], d = t[2];
    const double ab = rest_length(cloth, a, b), ac = rest_length(cloth, a, c), bc = rest_length(cloth, b, c);
    const double ad = rest_length(cloth, a, d), bd = rest_length(cloth, b, d);
    const double at_a_c = cotangent(bc, ab, ac), at_b_c = cotangent(ac, ab, bc);
    const double at_a_d = cotangent(bd, ab, ad), at_b_d = cotangent(ad, ab, bd);
    const double area = triangle_area(ab, ac, bc) + triangle_area(ab, ad, bd);
    hinges.push_back({{a, b, c, d},
                      {at_b_c + at_b_d, at_a_c + at_a_d, -at_a_c - at_b_c, -at_a_d - at_b_d},
                      area / (stiffness * bending_part(cloth, a, b))});
  }
  return hinges;
}

}  // namespace dressform
