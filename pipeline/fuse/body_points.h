#pragma once
#include "scenes/mesh.h"

namespace dressform {

struct BodyPointsOptions {
  double floor_cut_m = 0.010;  // points lower than this belong to the floor
  double gap_m = 0.015;        // points farther apart than this are different things
};

// The points of the body among those of a scan (model frame, y up, floor y = 0): above the floor and joined to what
// stands nearest to the axis (x, z). Empty when there is nothing.
PointCloud body_points(const PointCloud& cloud, double axis_x, double axis_z, const BodyPointsOptions& options);

// Points with normals downwards on the floor, under what stands on it: the soles that no sensor sees.
PointCloud sole_points(const PointCloud& body, double spacing_m);

}  // namespace dressform
