#include "pipeline/common/mesh_tidy.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

namespace dressform {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface to_cgal(const Mesh& mesh) {
  Surface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex({v.x(), v.y(), v.z()});
  for (const Vector3i& t : mesh.triangles)
    surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2]));
  return surface;
}

Mesh from_cgal(Surface& surface) {
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

Mesh tidied(const Mesh& mesh, double shortest_m) {
  if (mesh.triangles.empty() || !topology(mesh).closed()) return mesh;
  Surface surface = to_cgal(mesh);
  const sms::Edge_length_stop_predicate<double> stop(shortest_m);
  sms::edge_collapse(
      surface, stop,
      CGAL::parameters::get_cost(sms::Edge_length_cost<Surface>()).get_placement(sms::Midpoint_placement<Surface>()));
  return evened(from_cgal(surface), 3);
}

Mesh evened(const Mesh& mesh, int rounds) {
  Mesh result = mesh;
  std::vector<char> fixed(mesh.vertices.size(), 0);
  for (const auto& loop : boundary_loops(mesh))
    for (const int v : loop) fixed[v] = 1;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Vector3d> normals = vertex_normals(result);
    std::vector<Vector3d> sum(result.vertices.size(), Vector3d::Zero());
    std::vector<int> count(result.vertices.size(), 0);
    for (const Vector3i& t : result.triangles)
      for (int k = 0; k < 3; ++k) {
        sum[t[k]] += result.vertices[t[(k + 1) % 3]] + result.vertices[t[(k + 2) % 3]];
        count[t[k]] += 2;
      }
    for (std::size_t i = 0; i < result.vertices.size(); ++i) {
      if (fixed[i] || count[i] == 0) continue;
      Vector3d move = sum[i] / count[i] - result.vertices[i];
      move -= normals[i] * normals[i].dot(move);
      result.vertices[i] += 0.5 * move;
    }
  }
  return result;
}

}  // namespace dressform
