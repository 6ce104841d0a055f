#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "scenes/mesh.h"

namespace dressform {

using ExactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactSurface = CGAL::Surface_mesh<ExactKernel::Point_3>;

// scenes/surface_mesh.h for this kernel.
ExactSurface to_exact(const Mesh& mesh);
Mesh from_exact(ExactSurface surface);

}  // namespace dressform
