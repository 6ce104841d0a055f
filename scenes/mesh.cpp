#include "scenes/mesh.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

struct Edge {
  int low, high;    // vertices
  int first, last;  // range in `sides`
  int count() const { return last - first; }
};

// Undirected edges in the order of their vertices, with the triangle sides that lie on each.
struct EdgeTable {
  std::vector<Edge> edges;
  std::vector<int> sides;         // 3 * triangle + k: the side from corner k to corner k + 1; grouped by edge
  std::vector<int> edge_of_side;  // -1 for a side of no length (both corners the same vertex)
};

EdgeTable edge_table(const Mesh& mesh) {
  struct Side {
    int low, high, side;
  };
  std::vector<Side> all;
  all.reserve(mesh.triangles.size() * 3);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (a != b) all.push_back({std::min(a, b), std::max(a, b), 3 * t + k});
    }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side);
  });
  EdgeTable table;
  table.edge_of_side.assign(mesh.triangles.size() * 3, -1);
  for (const Side& side : all) {
    if (table.edges.empty() || table.edges.back().low != side.low || table.edges.back().high != side.high) {
      const int next = static_cast<int>(table.sides.size());
      table.edges.push_back({side.low, side.high, next, next});
    }
    table.edge_of_side[side.side] = static_cast<int>(table.edges.size()) - 1;
    table.sides.push_back(side.side);
    table.edges.back().last = static_cast<int>(table.sides.size());
  }
  return table;
}

// The boundary edge that follows `edge` round `vertex`: through the fan of triangles between the two.
int next_boundary_edge(const Mesh& mesh, const EdgeTable& table, int edge, int vertex) {
  int side = table.sides[table.edges[edge].first];
  while (true) {
    const int triangle = side / 3;
    int other = -1;  // the triangle's other side at the vertex
    for (int k = 0; k < 3; ++k) {
      const int candidate = 3 * triangle + k, candidate_edge = table.edge_of_side[candidate];
      const auto& corners = mesh.triangles[triangle];
      const bool at_vertex = corners[k] == vertex || corners[(k + 1) % 3] == vertex;
      if (candidate_edge >= 0 && candidate_edge != table.edge_of_side[side] && at_vertex) other = candidate;
    }
    if (other < 0) return edge;  // a triangle folded to a line
    const Edge& crossed = table.edges[table.edge_of_side[other]];
    if (crossed.count() == 1) return table.edge_of_side[other];
    side = table.sides[crossed.first] == other ? table.sides[crossed.first + 1] : table.sides[crossed.first];
  }
}

std::vector<std::vector<int>> walk_loops(const Mesh& mesh, const EdgeTable& table) {
  std::vector<std::vector<int>> loops;
  std::vector<char> seen(table.edges.size(), 0);
  for (int start = 0; start < static_cast<int>(table.edges.size()); ++start) {
    if (table.edges[start].count() != 1 || seen[start]) continue;
    const int side = table.sides[table.edges[start].first];
    int vertex = mesh.triangles[side / 3][side % 3];
    std::vector<int> loop;
    for (int edge = start; !seen[edge]; edge = next_boundary_edge(mesh, table, edge, vertex)) {
      seen[edge] = 1;
      loop.push_back(vertex);
      vertex = table.edges[edge].low + table.edges[edge].high - vertex;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<char> used_vertices(const Mesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) used[triangle[k]] = 1;
  return used;
}

int connected_boundaries(const Mesh& mesh, const EdgeTable& table) {
  DisjointSets sets(mesh.vertices.size());
  std::vector<char> on_boundary(mesh.vertices.size(), 0);
  for (const Edge& edge : table.edges) {
    if (edge.count() != 1) continue;
    on_boundary[edge.low] = on_boundary[edge.high] = 1;
    sets.join(edge.low, edge.high);
  }
  int count = 0;
  for (int v = 0; v < static_cast<int>(on_boundary.size()); ++v) count += on_boundary[v] && sets.root(v) == v;
  return count;
}

}  // namespace

std::vector<Vector3d> vertex_normals(const Mesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d doubled_area = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    for (int k = 0; k < 3; ++k) normals[t[k]] += doubled_area;
  }
  for (auto& normal : normals) normal = normal.squaredNorm() > 0 ? normal.normalized() : Vector3d::UnitY();
  return normals;
}

std::vector<std::vector<int>> boundary_loops(const Mesh& mesh) {
  const EdgeTable table = edge_table(mesh);
  for (const Edge& edge : table.edges)
    if (edge.count() > 2)
      throw std::invalid_argument("boundary_loops: the edge between vertices " + std::to_string(edge.low) + " and " +
                                  std::to_string(edge.high) + " has " + std::to_string(edge.count()) + " triangles");
  return walk_loops(mesh, table);
}

Topology topology(const Mesh& mesh) {
  const EdgeTable table = edge_table(mesh);
  const std::vector<char> used = used_vertices(mesh);
  Topology result;
  result.vertices = static_cast<int>(std::count(used.begin(), used.end(), 1));
  result.edges = static_cast<int>(table.edges.size());
  result.triangles = static_cast<int>(mesh.triangles.size());
  DisjointSets sets(mesh.vertices.size());
  for (const Edge& edge : table.edges) {
    result.boundary_edges += edge.count() == 1;
    result.non_manifold_edges += edge.count() > 2;
    sets.join(edge.low, edge.high);
  }
  for (int v = 0; v < static_cast<int>(used.size()); ++v) result.components += used[v] && sets.root(v) == v;
  result.loops =
      result.non_manifold_edges ? connected_boundaries(mesh, table) : static_cast<int>(walk_loops(mesh, table).size());
  return result;
}

Mesh compacted(const Mesh& mesh) {
  const std::vector<char> used = used_vertices(mesh);
  std::vector<int> renumbered(mesh.vertices.size(), -1);
  Mesh result;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    renumbered[v] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(mesh.vertices[v]);
  }
  result.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    result.triangles.emplace_back(renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]);
  return result;
}

Mesh transformed(const Mesh& mesh, const Eigen::Matrix4d& target_from_source) {
  Mesh result = mesh;
  const Eigen::Matrix3d rotation = target_from_source.topLeftCorner<3, 3>();
  const Vector3d shift = target_from_source.topRightCorner<3, 1>();
  for (auto& vertex : result.vertices) vertex = (rotation * vertex + shift).eval();
  return result;
}

}  // namespace dressform
