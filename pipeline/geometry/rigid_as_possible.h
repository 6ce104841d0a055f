#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// The mesh with some vertices put to places, and the others so that every vertex's neighbourhood is turned but deformed
// least (Sorkine and Alexa, "As-rigid-as-possible surface modeling", SGP 2007; Open3D's, spokes with cotangent
// weights). Every piece of the mesh needs a vertex that is put somewhere. Empty where there is no answer: pieces that
// nothing holds, or triangles without area, whose cotangents are infinite. Throws std::invalid_argument for lists of
// different lengths or vertices that are not there.
Mesh rigid_as_possible(const Mesh& mesh, const std::vector<int>& put, const std::vector<Vector3d>& places, int rounds);

}  // namespace dressform
