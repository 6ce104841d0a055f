#pragma once
#include <string>

#include "scenes/mesh.h"

namespace dressform {

// Why the open mesh is no garment with so many openings; empty if it is one.
std::string flaw_of(const Mesh& mesh, int openings);

}  // namespace dressform
