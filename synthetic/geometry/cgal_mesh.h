#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "scenes/mesh.h"

namespace dressform {

using ExactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactSurface = CGAL::Surface_mesh<ExactKernel::Point_3>;

// Triangles that would make the surface no manifold are left out: it then has fewer faces than the mesh.
ExactSurface to_exact(const Mesh& mesh);

// Vertices and faces in the surface's order, without what was removed from it.
Mesh from_exact(ExactSurface surface);

}  // namespace dressform
