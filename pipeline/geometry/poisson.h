#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Screened Poisson surface (Kazhdan and Hoppe, 2013; Open3D's copy of the authors' code) of points with outward
// normals, metres. `depth`: of the octree, whose cube's edge is `scale` times the points' largest extent. Runs on one
// thread, because more than one gives other vertices each time. Not always quite closed, and cut off where it leaves
// the cube: check topology(). Empty for no points.
Mesh poisson_surface(const PointCloud& cloud, int depth, double scale = 1.1);

// Unit normals by principal components of each point's nearest neighbours (Hoppe et al., SIGGRAPH 1992), on the side of
// `towards` (one direction a point, of any length). Throws std::invalid_argument for a list of another length.
std::vector<Vector3d> pca_normals(const std::vector<Vector3d>& points, int neighbours,
                                  const std::vector<Vector3d>& towards);

}  // namespace dressform
