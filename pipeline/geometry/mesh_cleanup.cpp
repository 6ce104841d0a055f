#include "pipeline/geometry/mesh_cleanup.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <utility>

#include "pipeline/geometry/cgal_mesh.h"

namespace dressform {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;

// Marching tetrahedra leave six times the triangles that are kept, most of them slivers: taken off in the mesh's own
// order first, the queue by length (half of the time of closing a body) gets a third of the edges.
constexpr double kSliver = 0.5;        // of the shortest edge that stays
constexpr int kSliverPasses = 3;       // a collapse makes few new ones
constexpr double kFewCollapses = .01;  // of the edges: the queue does the rest

void collapse_slivers(CgalSurface& surface, double longest_m) {
  for (int pass = 0; pass < kSliverPasses; ++pass) {
    std::size_t collapsed = 0;
    for (const auto edge : surface.edges()) {
      if (surface.is_removed(edge)) continue;
      const auto &a = surface.point(surface.source(surface.halfedge(edge))),
                 &b = surface.point(surface.target(surface.halfedge(edge)));
      if (CGAL::squared_distance(a, b) > longest_m * longest_m) continue;
      if (!CGAL::Euler::does_satisfy_link_condition(edge, surface)) continue;
      const auto middle = CGAL::midpoint(a, b);
      surface.point(CGAL::Euler::collapse_edge(edge, surface)) = middle;
      ++collapsed;
    }
    if (collapsed < kFewCollapses * surface.number_of_edges()) break;
  }
  surface.collect_garbage();
}

}  // namespace

Mesh edge_collapsed(const Mesh& mesh, double shortest_m) {
  if (mesh.triangles.empty() || !topology(mesh).closed()) return mesh;
  CgalSurface surface = to_cgal(mesh);
  collapse_slivers(surface, kSliver * shortest_m);
  const sms::Edge_length_stop_predicate<double> stop(shortest_m);
  sms::edge_collapse(surface, stop,
                     CGAL::parameters::get_cost(sms::Edge_length_cost<CgalSurface>())
                         .get_placement(sms::Midpoint_placement<CgalSurface>()));
  return tangentially_smoothed(from_cgal(std::move(surface)), 3);
}

Mesh tangentially_smoothed(const Mesh& mesh, int rounds) {
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
