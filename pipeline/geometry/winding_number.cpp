#include "pipeline/geometry/winding_number.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr int kLeaf = 8;    // triangles whose solid angles are added one by one
constexpr double kFar = 3;  // radii away from which a node is a dipole: at the paper's 2 some points are 0.03 off
constexpr double kFourPi = 4 * M_PI;

// Solid angle of a triangle seen from the origin over 4 pi (van Oosterom and Strackee, 1983), positive from behind.
double solid_angle_part(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double over = a.dot(b.cross(c)), under = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2 * std::atan2(over, under) / kFourPi;
}

}  // namespace

WindingNumber::WindingNumber(const Mesh& mesh) {
  for (const Vector3i& t : mesh.triangles)
    triangles_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  if (!triangles_.empty()) build(0, static_cast<int>(triangles_.size()));
}

int WindingNumber::build(int first, int last) {
  const int number = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.first = first;
  node.last = last;
  double area = 0;
  Vector3d low = triangles_[first].a, high = low, plain = Vector3d::Zero();
  for (int i = first; i < last; ++i) {
    const Triangle& t = triangles_[i];
    const Vector3d normal = 0.5 * (t.b - t.a).cross(t.c - t.a), middle = (t.a + t.b + t.c) / 3;
    node.area += normal;
    node.centre += normal.norm() * middle;
    plain += middle;
    area += normal.norm();
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  node.centre = area > 0 ? Vector3d(node.centre / area) : Vector3d(plain / (last - first));
  for (int i = first; i < last; ++i)
    for (const Vector3d& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c})
      node.radius_m = std::max(node.radius_m, (corner - node.centre).norm());
  if (last - first > kLeaf) {
    int axis = 0;
    (high - low).maxCoeff(&axis);
    // Stable, so that equal middles keep the mesh's order and the tree is the same everywhere.
    std::stable_sort(
        triangles_.begin() + first, triangles_.begin() + last, [axis](const Triangle& left, const Triangle& right) {
          return left.a[axis] + left.b[axis] + left.c[axis] < right.a[axis] + right.b[axis] + right.c[axis];
        });
    node.left = build(first, (first + last) / 2);
    node.right = build((first + last) / 2, last);
  }
  nodes_[number] = node;
  return number;
}

double WindingNumber::of_node(int number, const Vector3d& point) const {
  const Node& node = nodes_[number];
  const Vector3d away = node.centre - point;
  const double distance = away.norm();
  if (distance > kFar * node.radius_m) return node.area.dot(away) / (kFourPi * distance * distance * distance);
  if (node.left >= 0) return of_node(node.left, point) + of_node(node.right, point);
  double sum = 0;
  for (int i = node.first; i < node.last; ++i)
    sum += solid_angle_part(triangles_[i].a - point, triangles_[i].b - point, triangles_[i].c - point);
  return sum;
}

double WindingNumber::operator()(const Vector3d& point) const { return nodes_.empty() ? 0 : of_node(0, point); }

}  // namespace dressform
