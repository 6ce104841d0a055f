#pragma once
#include "synthetic/body/body.h"

namespace dressform {

// Landmarks and joints of anyone's closed standing body, measured by horizontal slices, which do not depend on how the
// surface is cut into triangles: legs part at the crotch, arms part at the armpits, girth extrema give chest, waist and
// hip. World frame: stands on y = 0, faces +z. Throws InputError naming `where` when the mesh is not closed or its
// slices are not those of a standing figure.
Body measure_body(Mesh mesh, const std::string& where);

}  // namespace dressform
