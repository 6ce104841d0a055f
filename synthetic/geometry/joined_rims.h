#pragma once
#include "scenes/mesh.h"

namespace dressform {

// The surface with the vertices of its boundaries joined where they lie within 0.1 mm of one another, except where an
// edge would get more than two triangles; triangles that name a vertex twice, and doubles, are left out. Vertices keep
// their numbers, unused ones stay.
TexturedMesh joined_rims(TexturedMesh textured);

}  // namespace dressform
