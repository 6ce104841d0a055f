#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Weights of the corners of triangle (a, b, c) at its point closest to p (Ericson, Real-Time Collision
// Detection, 5.1.5). Also of triangles that are a line or a point.
Vector3d closest_barycentric(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

// Of a mesh's triangle, and of all of them in order.
double triangle_area_m2(const Mesh& mesh, const Vector3i& triangle);
std::vector<double> triangle_areas_m2(const Mesh& mesh);

}  // namespace dressform
