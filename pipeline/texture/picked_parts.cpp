#include "pipeline/texture/picked_parts.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "pipeline/geometry/path_strip.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

constexpr double kWider = 1.2;    // from one try to the next
constexpr double kSegment = 0.5;  // of a mean edge: the longest part of a path, so that it leaves no gap

// The border with its ends drawn on to the mesh's boundary where that is near.
std::vector<Vector3d> to_the_rims(std::vector<Vector3d> border, const std::vector<Vector3d>& boundary, double reach_m) {
  for (int end = 0; end < 2 && !border.empty(); ++end) {
    const Vector3d from = border.back();
    double nearest = reach_m;
    Vector3d to = from;
    for (const Vector3d& p : boundary)
      if (const double distance = (p - from).norm(); distance < nearest) nearest = distance, to = p;
    border.push_back(to);
    std::reverse(border.begin(), border.end());
  }
  return border;
}

// The parts between the strips that are large enough, numbered from 0; -1: strip, or a small piece.
struct Parts {
  std::vector<int> of_triangle;
  int count = 0;
};
Parts parts_within(const TriangleNeighbours& neighbours, const std::vector<double>& areas,
                   const std::vector<double>& distances, double radius, double least_m2) {
  std::vector<char> kept(distances.size());
  for (std::size_t t = 0; t < kept.size(); ++t) kept[t] = distances[t] > radius;
  const Pieces pieces = edge_connected_pieces(neighbours, kept);
  std::vector<double> area(pieces.count, 0);
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t]) area[pieces.of_triangle[t]] += areas[t];
  Parts parts{std::vector<int>(kept.size(), -1), 0};
  std::vector<int> number(pieces.count, -1);
  for (int i = 0; i < pieces.count; ++i)
    if (area[i] >= least_m2) number[i] = parts.count++;
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t]) parts.of_triangle[t] = number[pieces.of_triangle[t]];
  return parts;
}

// The view that most of each part faces.
std::vector<int> views_of(const Parts& parts, const Mesh& mesh, const std::vector<ColorView>& views) {
  std::vector<std::vector<double>> facing(parts.count, std::vector<double>(views.size(), 0));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.of_triangle[t] < 0) continue;
    const Vector3d &a = mesh.vertices[mesh.triangles[t][0]], &b = mesh.vertices[mesh.triangles[t][1]],
                   &c = mesh.vertices[mesh.triangles[t][2]];
    const Vector3d area = (b - a).cross(c - a) / 2;
    for (std::size_t i = 0; i < views.size(); ++i)
      facing[parts.of_triangle[t]][i] += std::max(0.0, area.dot((views[i].eye - a).normalized()));
  }
  std::vector<int> result;
  for (const auto& each : facing)
    result.push_back(static_cast<int>(std::max_element(each.begin(), each.end()) - each.begin()));
  return result;
}

// Triangles without a view (-1) take that of the nearest one that has one, by steps from triangle to triangle.
void spread(const TriangleNeighbours& neighbours, std::vector<int>& view) {
  std::vector<int> front(view.size());
  std::iota(front.begin(), front.end(), 0);
  front.erase(std::remove_if(front.begin(), front.end(), [&](int t) { return view[t] < 0; }), front.end());
  while (!front.empty()) {
    std::vector<int> next;
    for (const int t : front)
      for (const int n : neighbours[t])
        if (n >= 0 && view[n] < 0) {
          view[n] = view[t];
          next.push_back(n);
        }
    front = std::move(next);
  }
}

}  // namespace

std::vector<int> parts_between(const Mesh& mesh, const std::vector<std::vector<Vector3d>>& borders,
                               const std::vector<ColorView>& views, const PickedPartsParams& params) {
  std::vector<int> result(mesh.triangles.size(), -1);
  if (views.empty() || mesh.triangles.empty()) return result;
  const MeshQuery query(mesh);
  const double edge_m = mean_edge_m(mesh);
  std::vector<Vector3d> boundary, along;
  for (const auto& loop : boundary_loops(mesh))
    for (const int v : loop) boundary.push_back(mesh.vertices[v]);
  for (const auto& border : borders) {
    const auto points = path_midpoints(query, to_the_rims(border, boundary, params.to_rim_m), false, kSegment * edge_m);
    along.insert(along.end(), points.begin(), points.end());
  }
  const TriangleNeighbours neighbours = triangle_neighbours(mesh);
  const std::vector<double> areas = triangle_areas_m2(mesh), distances = centroid_distances(mesh, along);
  const double least_m2 = params.least_part * std::accumulate(areas.begin(), areas.end(), 0.0);
  const double first = params.narrowest * edge_m;
  Parts parts = parts_within(neighbours, areas, distances, first, least_m2);
  for (double radius = kWider * first; radius <= params.widest_m; radius *= kWider)
    if (Parts more = parts_within(neighbours, areas, distances, radius, least_m2); more.count > parts.count)
      parts = std::move(more);
  const std::vector<int> view = views_of(parts, mesh, views);
  for (std::size_t t = 0; t < result.size(); ++t)
    if (parts.of_triangle[t] >= 0) result[t] = view[parts.of_triangle[t]];
  spread(neighbours, result);
  for (int& each : result) each = std::max(each, 0);  // a piece of nothing but strip
  return result;
}

}  // namespace dressform
