#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

using Eigen::Vector2d;

// One connected curve in which a plane cuts a mesh; a closed one does not repeat its first point.
struct SectionCurve {
  std::vector<Vector3d> points;
  bool closed = true;
};

// The curves in which the plane through `origin` with unit `normal` cuts the mesh, longest first. A closed mesh gives
// closed curves only.
std::vector<SectionCurve> plane_section(const Mesh& mesh, const Vector3d& origin, const Vector3d& normal);

// The horizontal section at height y as (z, x) polygons, largest area first.
struct Polygon {
  std::vector<Vector2d> points;  // (x, z)
  double area = 0;               // >= 0
  Vector2d centroid{0, 0};
};
std::vector<Polygon> horizontal_section(const Mesh& mesh, double y);

// The torso's part of a horizontal section: the largest polygon, and below the crotch the other leg with it; arms and
// hands left out. Empty where the plane misses the mesh.
std::vector<Polygon> torso_part(const std::vector<Polygon>& polygons);

// Convex hull, counter-clockwise (x to the right, z up), without repeated or collinear points (Andrew's chain).
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points);

// Whether the origin lies inside a closed curve.
bool goes_round_origin(const std::vector<Vector2d>& polygon);

double polygon_length(const std::vector<Vector2d>& closed);

}  // namespace dressform
