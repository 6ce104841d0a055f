#include "eval/report/rim_marks.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kRadius_m = 0.004;  // a few pixels of the report's images

void append(Mesh& mesh, const Mesh& part) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& t : part.triangles) mesh.triangles.push_back(t + Vector3i::Constant(first));
}

}  // namespace

Mesh tube_along(const std::vector<Vector3d>& loop, double radius_m, const std::vector<char>& wanted) {
  constexpr int kSides = 6;
  Mesh tube;
  const int count = static_cast<int>(loop.size());
  if (count < 3) return tube;
  Vector3d across = Vector3d::UnitY();  // carried along the line, so that rings do not twist against one another
  for (int i = 0; i < count; ++i) {
    const Vector3d along = (loop[(i + 1) % count] - loop[(i + count - 1) % count]).normalized();
    Vector3d side = across - along * along.dot(across);
    if (side.norm() < 1e-6) side = along.unitOrthogonal();
    across = side.normalized();
    const Vector3d other = along.cross(across);
    for (int k = 0; k < kSides; ++k) {
      const double turn = 2 * M_PI * k / kSides;
      tube.vertices.push_back(loop[i] + radius_m * (std::cos(turn) * across + std::sin(turn) * other));
    }
  }
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < kSides && (wanted.empty() || wanted[i]); ++k) {
      const int a = i * kSides + k, b = i * kSides + (k + 1) % kSides;
      const int c = (i + 1) % count * kSides + k, d = (i + 1) % count * kSides + (k + 1) % kSides;
      tube.triangles.push_back({a, b, d});
      tube.triangles.push_back({a, d, c});
    }
  return tube;
}

RimMarks rim_marks(const OpenGarment& garment) {
  RimMarks marks;
  for (const auto& rim : garment.rims) {
    std::vector<char> unseen = rim.hidden, seen;
    if (unseen.empty() || !rim.observed) unseen.assign(rim.points.size(), !rim.observed);
    for (const char hidden : unseen) seen.push_back(!hidden);
    append(marks.seen, tube_along(rim.points, kRadius_m, seen));
    append(marks.unseen, tube_along(rim.points, kRadius_m, unseen));
  }
  return marks;
}

std::string unseen_rims_caption(const OpenGarments& opened) {
  std::string names;
  for (const auto& [slot, garment] : opened.garments)
    for (const auto& rim : garment.rims) {
      const int percent = static_cast<int>(std::lround(100 * rim.unseen_part()));
      if (percent == 0) continue;
      const std::string part = rim.observed ? std::to_string(percent) + " % of the " : "the ";
      std::string name = rim.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      names += (names.empty() ? "" : ", ") + part + slot + "'s " + name;
    }
  return names.empty() ? "" : "No view saw " + names + ": carried on from what was seen.";
}

}  // namespace dressform
