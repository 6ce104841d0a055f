#include "synthetic/garments/drape/fall.h"

#include <set>

#include "scenes/error.h"
#include "synthetic/geometry/self_intersection.h"

namespace dressform {
namespace {

constexpr double kMostStrain = 0.045;  // that 95 % of the edges shall keep to
constexpr double kFurther = 0.00225;   // off the body at a time, m

// Lets the cloth fall, and goes on twice at most where it does not come to rest. The cloth as it then lies.
ClothRest let_fall(Cloth& cloth, const Wearer& wearer, DrapeParams params, Seed seed) {
  constexpr int kMoreTimes = 2;
  DrapeResult result;
  for (int time = 0; time <= kMoreTimes && !result.converged; ++time) {
    result = drape(cloth, wearer, params, seed);
    cloth.mesh.vertices = result.vertices;
    params.grow_part = params.ruffle_m = 0;
  }
  return {result.converged, result.speed_m_per_s, result.strain_p95};
}

}  // namespace

ClothRest let_fall_first(Cloth& cloth, const Wearer& wearer, DrapeParams& params, Seed seed) {
  const ClothRest rest = let_fall(cloth, wearer, params, seed);
  if (rest.strain_p95 <= kMostStrain) return rest;
  params.step_s /= 2;
  params.seconds /= 2;
  params.grow_part = params.ruffle_m = 0;
  return let_fall(cloth, wearer, params, seed);
}

ClothRest let_fall_clear(Cloth& cloth, Wearer wearer, const DrapeParams& params, const Mesh& body, Seed seed) {
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    const ClothRest rest = let_fall(cloth, wearer, params, seed);
    const std::vector<int> crossing = crossing_triangles(cloth.mesh, body);
    if (crossing.empty()) return rest;
    std::set<int> corners;
    for (int t : crossing)
      for (int k = 0; k < 3; ++k) corners.insert(cloth.mesh.triangles[t][k]);
    for (int i : corners) {
      wearer.clearance_m[i] += kFurther;
      cloth.held[i] = 0;
    }
  }
  throw InputError("garment.cloth_edge_m",
                   "found triangles too large to lie on this body without cutting through it; "
                   "expected a smaller edge");
}

}  // namespace dressform
