#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// The mesh's triangles for which `kept` (one each) is not zero, with the vertices they have. Throws
// std::invalid_argument for a list of another length.
Mesh submesh(const Mesh& mesh, const std::vector<char>& kept);

}  // namespace dressform
