#pragma once
#include <array>
#include <vector>

#include "pipeline/geometry/mesh_query.h"

namespace dressform {

// Cutting a mesh along paths that a person picked on it (section 3.4.2 of the thesis): what is near the path goes, and
// the surface falls apart.

// For each triangle, those across the edges from corner k to corner k + 1: -1 where there is none, or more than one.
using TriangleNeighbours = std::vector<std::array<int, 3>>;
TriangleNeighbours triangle_neighbours(const Mesh& mesh);

// Pieces of the triangles that are kept (a flag each), joined across edges: a number from 0 for each triangle, -1 for
// those that are not kept.
struct Pieces {
  std::vector<int> of_triangle;
  int count = 0;
};
Pieces edge_connected_pieces(const TriangleNeighbours& neighbours, const std::vector<char>& kept);

double mean_edge_m(const Mesh& mesh);  // over the triangles' sides; 0 for none

// The middles of a path's segments, no segment longer than `longest_m`, each moved to the nearest point of the surface.
// `closed`: the last point is joined to the first. A path of one point is that point.
std::vector<Vector3d> path_midpoints(const MeshQuery& surface, const std::vector<Vector3d>& path, bool closed,
                                     double longest_m);

// Distance of every triangle's centroid from the nearest of the points; infinity where there are none.
std::vector<double> centroid_distances(const Mesh& mesh, const std::vector<Vector3d>& points);

}  // namespace dressform
