#pragma once
#include "scenes/mesh.h"

namespace dressform {

// An open mesh closed: each boundary loop is carried on by `margin_m` the way the cloth runs there on the mean, and
// capped by a fan. Throws std::invalid_argument when an edge has more than two triangles.
Mesh capped(const Mesh& open, double margin_m);

}  // namespace dressform
