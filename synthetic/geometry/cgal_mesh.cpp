#include "synthetic/geometry/cgal_mesh.h"

namespace dressform {

ExactSurface to_exact(const Mesh& mesh) {
  ExactSurface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex(ExactKernel::Point_3(v.x(), v.y(), v.z()));
  for (const Vector3i& t : mesh.triangles) {
    const auto vertex = [&](int k) { return ExactSurface::Vertex_index(static_cast<ExactSurface::size_type>(t[k])); };
    surface.add_face(vertex(0), vertex(1), vertex(2));
  }
  return surface;
}

Mesh from_exact(ExactSurface surface) {
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
