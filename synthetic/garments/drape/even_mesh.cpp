#include "synthetic/garments/drape/even_mesh.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <stdexcept>

#include "synthetic/geometry/cgal_mesh.h"

namespace dressform {

Mesh even_mesh(const Mesh& mesh, const std::vector<int>& piece, double edge_m) {
  constexpr int kRounds = 4;
  ExactSurface surface = to_exact(mesh);
  if (surface.number_of_faces() != mesh.triangles.size())
    throw std::runtime_error("even_mesh: the mesh is not manifold");
  auto seam = surface.add_property_map<ExactSurface::Edge_index, bool>("e:seam", false).first;
  for (const auto e : surface.edges()) {
    const auto h = surface.halfedge(e);
    if (surface.is_border(e)) {
      seam[e] = true;
      continue;
    }
    seam[e] = piece[surface.face(h).idx()] != piece[surface.face(surface.opposite(h)).idx()];
  }
  namespace PMP = CGAL::Polygon_mesh_processing;
  PMP::isotropic_remeshing(
      surface.faces(), edge_m, surface,
      CGAL::parameters::number_of_iterations(kRounds).number_of_relaxation_steps(2).edge_is_constrained_map(seam));
  return from_exact(std::move(surface));
}

}  // namespace dressform
