#include "pipeline/geometry/path_strip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipeline/geometry/point_tree.h"
#include "scenes/mesh_sides.h"

namespace dressform {

TriangleNeighbours triangle_neighbours(const Mesh& mesh) {
  TriangleNeighbours result(mesh.triangles.size(), {-1, -1, -1});
  for_edges(sorted_sides(mesh), [&](const TriangleSide* first, const TriangleSide* last) {
    if (last - first != 2) return;
    result[first[0].triangle][first[0].k] = first[1].triangle;
    result[first[1].triangle][first[1].k] = first[0].triangle;
  });
  return result;
}

Pieces edge_connected_pieces(const TriangleNeighbours& neighbours, const std::vector<char>& kept) {
  if (kept.size() != neighbours.size()) throw std::invalid_argument("edge_connected_pieces: one flag per triangle");
  Pieces pieces{std::vector<int>(kept.size(), -1), 0};
  std::vector<int> front;
  for (std::size_t first = 0; first < kept.size(); ++first) {
    if (!kept[first] || pieces.of_triangle[first] >= 0) continue;
    front.assign(1, static_cast<int>(first));
    pieces.of_triangle[first] = pieces.count;
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      for (const int next : neighbours[at])
        if (next >= 0 && kept[next] && pieces.of_triangle[next] < 0) {
          pieces.of_triangle[next] = pieces.count;
          front.push_back(next);
        }
    }
    ++pieces.count;
  }
  return pieces;
}

double mean_edge_m(const Mesh& mesh) {
  double sum = 0;
  for (const Vector3i& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) sum += (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm();
  return mesh.triangles.empty() ? 0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

std::vector<Vector3d> path_midpoints(const MeshQuery& surface, const std::vector<Vector3d>& path, bool closed,
                                     double longest_m) {
  std::vector<Vector3d> points;
  if (path.size() == 1) points = path;
  const std::size_t segments = path.size() < 2 ? 0 : closed ? path.size() : path.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vector3d &from = path[i], &to = path[(i + 1) % path.size()];
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from).norm() / longest_m)));
    for (int k = 0; k < parts; ++k) points.push_back(from + (to - from) * ((k + 0.5) / parts));
  }
  for (Vector3d& point : points)
    if (const auto closest = surface.closest(point); closest.triangle >= 0) point = closest.point;
  return points;
}

std::vector<double> centroid_distances(const Mesh& mesh, const std::vector<Vector3d>& points) {
  std::vector<double> distances(mesh.triangles.size(), std::numeric_limits<double>::infinity());
  if (points.empty()) return distances;
  const PointTree tree(points);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    const Vector3d centroid = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    std::uint32_t nearest = 0;
    double squared = 0;
    if (tree.nearest(centroid, nearest, squared)) distances[i] = std::sqrt(squared);
  }
  return distances;
}

}  // namespace dressform
