#pragma once
#include <vector>

#include "scenes/ground_truth.h"
#include "scenes/mesh.h"
#include "scenes/scene.h"
#include "synthetic/body/body.h"

namespace dressform {

struct Garment {
  TexturedMesh textured;       // one-sided open surface, outward, world frame
  std::vector<TruthRim> rims;  // `visible` is filled in by the capture
  ClothRest rest;              // procedural: how it lies
  std::vector<double> rest_m;  // procedural: lengths at rest of the edges, in the order of features_of()
};

// The procedural garment on the body, or the scene's own mesh placed as given: seams joined, what is sewn on kept as
// pieces of their own (synthetic/geometry/mending.h), the rims those of its largest piece. `inner` are garments worn
// beneath it (the trousers under a shirt): a procedural one stays outside them. Throws InputError naming the mesh's
// file where it lies nowhere near the body, or has not the openings of its kind.
Garment make_garment(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed);

}  // namespace dressform
