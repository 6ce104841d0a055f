#pragma once
#include <array>
#include <vector>

#include "synthetic/garments/drape/cloth.h"
#include "synthetic/garments/drape/drape.h"

namespace dressform {

constexpr double kGravity = 9.81;  // m/s^2

struct Spring {
  int a, b;
  double first, rest, compliance;  // lengths: at the start, and the cloth's own
};

// Bends about an edge: the sum of weight * position over the edge's ends and the two corners opposite is zero where the
// cloth is flat.
struct Hinge {
  std::array<int, 4> vertex;
  std::array<double, 4> weight;
  double compliance;
};

// Inverse masses of the cloth's vertices, 0 for those that are held: it weighs 1 kg per square metre, and all other
// constants are relative to that.
std::vector<double> lightness_of(const Cloth& cloth);

// One for every edge that can move, from the top down.
std::vector<Spring> springs_of(const Cloth& cloth, const DrapeParams& params, const std::vector<double>& lightness);

// One for every inner edge.
std::vector<Hinge> hinges_of(const Cloth& cloth, const DrapeParams& params);

}  // namespace dressform
