#pragma once
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "scenes/mesh.h"

namespace dressform {

using CgalKernel = CGAL::Simple_cartesian<double>;
using CgalSurface = CGAL::Surface_mesh<CgalKernel::Point_3>;

// scenes/surface_mesh.h for this kernel.
CgalSurface to_cgal(const Mesh& mesh);
Mesh from_cgal(CgalSurface surface);

}  // namespace dressform
