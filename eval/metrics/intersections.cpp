#include "eval/metrics/intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <vector>

namespace dressform::metrics {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

struct Triangles {
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;
};

Triangles triangles_of(const Mesh& mesh) {
  Triangles result;
  const auto point = [&](int i) {
    const Vector3d& v = mesh.vertices[i];
    return Point(v.x(), v.y(), v.z());
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    result.triangles.emplace_back(point(t[0]), point(t[1]), point(t[2]));
    result.boxes.emplace_back(result.triangles.back().bbox(), static_cast<int>(i));
  }
  return result;
}

Segment longest_side(const Triangle& t) {
  Segment longest(t[0], t[1]);
  for (int k = 1; k < 3; ++k) {
    const Segment side(t[k], t[(k + 1) % 3]);
    if (side.squared_length() > longest.squared_length()) longest = side;
  }
  return longest;
}

bool share_a_point(const Triangle& a, const Triangle& b) {
  const bool flat_a = a.is_degenerate(), flat_b = b.is_degenerate();
  if (!flat_a && !flat_b) return CGAL::do_intersect(a, b);
  if (flat_a && flat_b) return CGAL::do_intersect(longest_side(a), longest_side(b));
  return flat_a ? CGAL::do_intersect(longest_side(a), b) : CGAL::do_intersect(a, longest_side(b));
}

// Two triangles with one common vertex (corner i of a, j of b) meet elsewhere if the side opposite to it, of either,
// meets the other triangle.
bool meet_beyond_vertex(const Triangle& a, int i, const Triangle& b, int j) {
  if (a.is_degenerate() || b.is_degenerate()) return false;
  return CGAL::do_intersect(Segment(a[(i + 1) % 3], a[(i + 2) % 3]), b) ||
         CGAL::do_intersect(Segment(b[(j + 1) % 3], b[(j + 2) % 3]), a);
}

}  // namespace

long intersecting_pairs(const Mesh& a, const Mesh& b) {
  Triangles first = triangles_of(a), second = triangles_of(b);
  long pairs = 0;
  CGAL::box_intersection_d(first.boxes.begin(), first.boxes.end(), second.boxes.begin(), second.boxes.end(),
                           [&](const Box& p, const Box& q) {
                             if (share_a_point(first.triangles[p.info()], second.triangles[q.info()])) ++pairs;
                           });
  return pairs;
}

long self_intersecting_pairs(const Mesh& mesh) {
  Triangles all = triangles_of(mesh);
  long pairs = 0;
  CGAL::box_self_intersection_d(all.boxes.begin(), all.boxes.end(), [&](const Box& p, const Box& q) {
    const Vector3i &s = mesh.triangles[p.info()], &t = mesh.triangles[q.info()];
    int common = 0, in_s = 0, in_t = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (s[i] == t[j]) ++common, in_s = i, in_t = j;
    const Triangle &a = all.triangles[p.info()], &b = all.triangles[q.info()];
    if (common == 0 ? share_a_point(a, b) : common == 1 && meet_beyond_vertex(a, in_s, b, in_t)) ++pairs;
  });
  return pairs;
}

}  // namespace dressform::metrics
