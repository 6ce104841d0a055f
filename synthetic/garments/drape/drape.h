#pragma once
#include <vector>

#include "scenes/registry.h"
#include "synthetic/garments/drape/cloth.h"
#include "synthetic/geometry/surface_distance.h"

namespace dressform {

// What cloth lies on. The body keeps vertices at their clearance; `layer` is other cloth, which nothing passes.
struct Wearer {
  const SurfaceDistance* body = nullptr;  // may be absent
  std::vector<double> clearance_m;        // one per vertex of the cloth
  Mesh layer;                             // may be empty
  double floor_y_m = -1e3;                // nothing falls below
};

struct DrapeParams {
  double bending_length_m = 0.02;  // a strip of the cloth bends by its own weight over about this length (Peirce)
  double stretch_per_m = 0.010;    // elongation of a metre of cloth that hangs from its end
  double friction = 0.4;           // on the body and on cloth
  double thickness_m = 0.003;      // least distance of cloth to cloth
  double seconds = 1.6;            // of the fall
  double step_s = 1.0 / 1500;
  double drag_per_s = 2.5;        // of the air, at first; it grows towards the end
  double grow_part = 0.1;         // of the time during which the cloth grows from how it was put on to its own size
  double ruffle_m = 0.002;        // unevenness at the start, so that folds have somewhere to begin
  double settled_m_per_s = 0.02;  // mean speed below which it counts as at rest
};

struct DrapeResult {
  std::vector<Vector3d> vertices;
  double strain_p95 = 0;        // |length / rest - 1| that 95 % of the edges keep to
  double speed_m_per_s = 0;     // mean over the vertices, during the last tenth of the time
  bool converged = false;       // speed below DrapeParams::settled_m_per_s
  int steps = 0, searches = 0;  // substeps, searches for near features
};

// Lets cloth fall and come to rest: extended position-based dynamics with small steps (Macklin et al., "XPBD", MIG
// 2016, and "Small steps in physics simulation", SCA 2019), edges as springs, quadratic bending (Bergou et al., SGP
// 2006), Coulomb friction. Metres, y up. No vertex moves further between two searches than the room to its next feature
// allows, so that cloth that does not intersect itself or the layer at the start never does. One thread; the same bytes
// for the same input.
DrapeResult drape(const Cloth& cloth, const Wearer& wearer, const DrapeParams& params, Seed seed);

}  // namespace dressform
