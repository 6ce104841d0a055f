#include "synthetic/garments/drape/even_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

namespace dressform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
  for (const Vector3i& t : mesh.triangles) {
    const auto vertex = [&](int k) { return Surface::Vertex_index(static_cast<Surface::size_type>(t[k])); };
    if (surface.add_face(vertex(0), vertex(1), vertex(2)) == Surface::null_face())
      throw std::runtime_error("even_mesh: the mesh is not manifold");
  }
  return surface;
}

Mesh mesh_of(Surface& surface) {
  surface.collect_garbage();
  Mesh mesh;
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    Vector3i t;
    int k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) t[k++] = static_cast<int>(v.idx());
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace

Mesh even_mesh(const Mesh& mesh, const std::vector<int>& piece, double edge_m) {
  constexpr int kRounds = 4;
  Surface surface = surface_of(mesh);
  auto seam = surface.add_property_map<Surface::Edge_index, bool>("e:seam", false).first;
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
  Mesh even = mesh_of(surface);
  return even;
}

}  // namespace dressform
