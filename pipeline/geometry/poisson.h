#pragma once
#include "scenes/mesh.h"

namespace dressform {

// Screened Poisson surface (Kazhdan and Hoppe, 2013; Open3D's copy of the authors' code) of points with outward
// normals, metres. `depth`: of the octree; the cube's edge is 1.1 times the points' largest extent. Runs on one thread,
// because more than one gives other vertices each time. Not always quite closed: check topology(). Empty for no points.
Mesh poisson_surface(const PointCloud& cloud, int depth);

}  // namespace dressform
