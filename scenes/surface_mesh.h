#pragma once
#include "scenes/mesh.h"

namespace dressform {

// Between Mesh and a CGAL::Surface_mesh of any kernel. For the few files that include CGAL: they name the Surface.

// Triangles that would make the surface no manifold are left out: it then has fewer faces than the mesh.
template <class Surface>
Surface to_surface(const Mesh& mesh) {
  Surface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex(typename Surface::Point(v.x(), v.y(), v.z()));
  for (const Vector3i& t : mesh.triangles) {
    const auto vertex = [&](int k) {
      return typename Surface::Vertex_index(static_cast<typename Surface::size_type>(t[k]));
    };
    surface.add_face(vertex(0), vertex(1), vertex(2));
  }
  return surface;
}

// Vertices and faces in the surface's order, without what was removed from it.
template <class Surface>
Mesh from_surface(Surface surface) {
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

}  // namespace dressform
