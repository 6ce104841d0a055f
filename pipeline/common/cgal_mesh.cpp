#include "pipeline/common/cgal_mesh.h"

namespace dressform {

CgalSurface to_cgal(const Mesh& mesh) {
  CgalSurface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex({v.x(), v.y(), v.z()});
  for (const Vector3i& t : mesh.triangles)
    surface.add_face(CgalSurface::Vertex_index(t[0]), CgalSurface::Vertex_index(t[1]), CgalSurface::Vertex_index(t[2]));
  return surface;
}

Mesh from_cgal(CgalSurface surface) {
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
