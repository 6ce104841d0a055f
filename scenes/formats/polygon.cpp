#include "scenes/formats/polygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace dressform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;  // number of the corner
using FaceInfo = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;      // 1 inside, 0 outside, -1 unknown
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfo>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

// Twice the polygon's area as a vector (Newell).
Vector3d doubled_area(const std::vector<Vector3d>& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  return sum;
}

Vector3d doubled_area(const std::vector<Vector3d>& corners, int a, int b, int c) {
  return (corners[b] - corners[a]).cross(corners[c] - corners[a]);
}

void add_fan(int count, std::vector<std::array<int, 3>>& triangles) {
  for (int i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
}

// Of the two ways to part a quadrilateral, one that stays within it; of two, the one along the shorter diagonal.
void add_quadrilateral(const std::vector<Vector3d>& corners, std::vector<std::array<int, 3>>& triangles) {
  const double first = doubled_area(corners, 0, 1, 2).dot(doubled_area(corners, 0, 2, 3));
  const double second = doubled_area(corners, 1, 2, 3).dot(doubled_area(corners, 1, 3, 0));
  const bool first_is_shorter = (corners[2] - corners[0]).squaredNorm() <= (corners[3] - corners[1]).squaredNorm();
  if ((first > 0) != (second > 0) ? first > 0 : first_is_shorter) {
    triangles.push_back({0, 1, 2});
    triangles.push_back({0, 2, 3});
  } else {
    triangles.push_back({1, 2, 3});
    triangles.push_back({1, 3, 0});
  }
}

// Every corner turns the way the polygon turns, once round.
bool is_convex(const std::vector<Vector3d>& corners, const Vector3d& normal) {
  const std::size_t n = corners.size();
  double turned = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d before = corners[(i + 1) % n] - corners[i], after = corners[(i + 2) % n] - corners[(i + 1) % n];
    const double sine = before.cross(after).dot(normal);
    if (!(sine > 0)) return false;
    turned += std::atan2(sine / normal.norm(), before.dot(after));
  }
  return turned < 3 * M_PI;
}

// The polygon in the plane of two axes, from where its area is seen largest: coordinates stay exact.
std::vector<Kernel::Point_2> flattened(const std::vector<Vector3d>& corners, const Vector3d& normal) {
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Kernel::Point_2> points;
  for (const Vector3d& corner : corners) points.emplace_back(corner[u], corner[v]);
  return points;
}

using Outline = std::map<std::pair<Vertex, Vertex>, int>;  // how often each edge is walked

// Marks the faces that one reaches from outside across an odd number of outlines. An edge that is walked twice (a
// bridge to a hole) parts nothing.
void mark_inside(Triangulation& triangulation, const Outline& outline) {
  for (const Face face : triangulation.all_face_handles()) face->info() = -1;
  std::vector<Face> open{triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Face beyond = face->neighbor(i);
      if (beyond->info() >= 0) continue;
      const std::pair<Vertex, Vertex> ends =
          std::minmax({face->vertex(Triangulation::cw(i)), face->vertex(Triangulation::ccw(i))});
      const auto walked = outline.find(ends);
      beyond->info() = walked != outline.end() && walked->second % 2 ? 1 - face->info() : face->info();
      open.push_back(beyond);
    }
  }
}

// Throws Triangulation::Intersection_of_constraints_exception where the outline crosses itself.
void fill(const std::vector<Kernel::Point_2>& points, std::vector<std::array<int, 3>>& triangles) {
  Triangulation triangulation;
  std::vector<Vertex> corners;
  std::map<Kernel::Point_2, Vertex> known;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [at, fresh] = known.try_emplace(points[i]);
    if (fresh) {
      at->second = triangulation.insert(points[i]);
      at->second->info() = static_cast<int>(i);
    }
    corners.push_back(at->second);
  }
  Outline outline;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vertex a = corners[i], b = corners[(i + 1) % corners.size()];
    if (a == b) continue;
    triangulation.insert_constraint(a, b);
    // A corner that lies on the edge parts it: what is walked are the pieces.
    std::vector<Vertex> along{a};
    while (along.back() != b) {
      Vertex next;
      Face face;
      int index;
      if (!triangulation.includes_edge(along.back(), b, next, face, index)) break;
      along.push_back(next);
    }
    for (std::size_t k = 1; k < along.size(); ++k) ++outline[std::minmax(along[k - 1], along[k])];
  }
  mark_inside(triangulation, outline);
  for (const Face face : triangulation.finite_face_handles())
    if (face->info() == 1)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
}

}  // namespace

bool triangulate(const std::vector<Vector3d>& corners, std::vector<std::array<int, 3>>& triangles) {
  const int count = static_cast<int>(corners.size());
  if (count == 3) {
    triangles.push_back({0, 1, 2});
    return true;
  }
  if (count == 4) {
    add_quadrilateral(corners, triangles);
    return true;
  }
  const Vector3d normal = doubled_area(corners);
  const double span = (corners[1] - corners[0]).squaredNorm() + (corners[count / 2] - corners[0]).squaredNorm();
  constexpr double kFlat = 1e-12;  // of the span squared: rounding of single precision
  if (!(normal.norm() > kFlat * span) || is_convex(corners, normal)) {
    add_fan(count, triangles);
    return true;
  }
  std::vector<std::array<int, 3>> filled;
  try {
    fill(flattened(corners, normal), filled);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  triangles.insert(triangles.end(), filled.begin(), filled.end());
  return true;
}

}  // namespace dressform
