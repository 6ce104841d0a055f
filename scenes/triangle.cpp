#include "scenes/triangle.h"

#include <Eigen/Geometry>

namespace dressform {

Vector3d closest_barycentric(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 - d3 > 0 ? d1 / (d1 - d3) : 0;
    return {1 - s, s, 0};
  }
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 - d6 > 0 ? d2 / (d2 - d6) : 0;
    return {1 - s, 0, s};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double span = (d4 - d3) + (d5 - d6);
    const double s = span > 0 ? (d4 - d3) / span : 0;
    return {0, 1 - s, s};
  }
  const double sum = va + vb + vc;
  return sum > 0 ? Vector3d(va / sum, vb / sum, vc / sum) : Vector3d(1, 0, 0);
}

double triangle_area_m2(const Mesh& mesh, const Vector3i& triangle) {
  const Vector3d& a = mesh.vertices[triangle[0]];
  return 0.5 * (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).norm();
}

std::vector<double> triangle_areas_m2(const Mesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const Vector3i& triangle : mesh.triangles) areas.push_back(triangle_area_m2(mesh, triangle));
  return areas;
}

}  // namespace dressform
