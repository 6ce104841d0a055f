#pragma once
#include "scenes/ground_truth.h"
#include "synthetic/garments/drape/drape.h"

namespace dressform {

// Lets cloth fall in its first, larger triangles, longer where it does not come to rest. Where it is stretched by its
// own weight it goes on in shorter steps, which carry that further up: `params` keeps them for what follows. Moves the
// cloth; returns how it lies.
ClothRest let_fall_first(Cloth& cloth, const Wearer& wearer, DrapeParams& params, Seed seed);

// Lets cloth fall in its final triangles. Where they cut through the body between their corners, the cloth is kept
// further off, as long as that takes, and held no more. Moves the cloth; returns how it lies. Throws InputError where
// that does not help.
ClothRest let_fall_clear(Cloth& cloth, Wearer wearer, const DrapeParams& params, const Mesh& body, Seed seed);

}  // namespace dressform
