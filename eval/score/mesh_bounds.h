#pragma once
#include <string>

#include "scenes/mesh.h"

namespace dressform {

// Meshes that others made are measured before memory and time are spent on them: points are spread over their area,
// so that a shirt in millimetres would ask for 10^12 of them. All throw InputError with what was found, what a person
// or a garment can be, and the likely cause.

// Length of the longest side of a box round a person, and round most garments: tells the likely unit.
constexpr double kPersonSide_m = 1.75, kGarmentSide_m = 0.75;

// Size, area and number of triangles. `where` names the file.
void check_mesh_bounds(const Mesh& mesh, const std::string& where, double usual_side_m = kGarmentSide_m);

// Two files that are to hold one surface (<slot>.ply and <slot>.glb) do: from the vertices of either to the triangles
// of the other it is a millimetre or two. `where`, `other`: their names.
void check_same_surface(const Mesh& mesh, const std::string& where, const Mesh& second, const std::string& other);

}  // namespace dressform
