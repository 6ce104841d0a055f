#include "pipeline/geometry/cgal_mesh.h"

#include <utility>

#include "scenes/surface_mesh.h"

namespace dressform {

CgalSurface to_cgal(const Mesh& mesh) { return to_surface<CgalSurface>(mesh); }

Mesh from_cgal(CgalSurface surface) { return from_surface(std::move(surface)); }

}  // namespace dressform
