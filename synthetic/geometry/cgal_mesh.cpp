#include "synthetic/geometry/cgal_mesh.h"

#include <utility>

#include "scenes/surface_mesh.h"

namespace dressform {

ExactSurface to_exact(const Mesh& mesh) { return to_surface<ExactSurface>(mesh); }

Mesh from_exact(ExactSurface surface) { return from_surface(std::move(surface)); }

}  // namespace dressform
