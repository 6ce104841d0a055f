#pragma once
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "scenes/mesh.h"

namespace dressform {

using CgalKernel = CGAL::Simple_cartesian<double>;
using CgalSurface = CGAL::Surface_mesh<CgalKernel::Point_3>;

// Triangles that would make the surface no manifold are left out: it then has fewer faces than the mesh.
CgalSurface to_cgal(const Mesh& mesh);

// Vertices and faces in the surface's order, without what was removed from it.
Mesh from_cgal(CgalSurface surface);

}  // namespace dressform
