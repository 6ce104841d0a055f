#pragma once
#include <map>
#include <string>

#include "scenes/mesh.h"

namespace dressform {

// Garments as one mesh with one texture, side by side and each at most `texture_px` high: small enough to lie inside a
// page. Garments without a texture or triangles are left out; u and v lie in 0 to 1. Empty for none.
TexturedMesh joined_garments(const std::map<std::string, TexturedMesh>& garments, int texture_px);

}  // namespace dressform
