#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Triangles between the points of a cloud: sheets with holes where points are missing, in general neither closed nor
// manifold. Open3D's, on one thread. Metres; triangles face the way the points' normals do. Empty for a cloud of fewer
// than four points.

// Median distance of a point from its nearest neighbour; 0 for fewer than two points.
double median_spacing_m(const std::vector<Vector3d>& points);

// Balls of the radii (ascending) rolled over the points (Bernardini et al., TVCG 1999).
Mesh ball_pivoting_sheet(const PointCloud& cloud, const std::vector<double>& radii_m);

// The boundary of the tetrahedra between the points whose circumscribed balls are smaller than `alpha_m` (Edelsbrunner
// and Muecke, ACM TOG 1994): of a sheet of points, both sides, here all turned the way of the normals.
Mesh alpha_shape_sheet(const PointCloud& cloud, double alpha_m);

}  // namespace dressform
