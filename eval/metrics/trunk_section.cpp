#include "eval/metrics/trunk_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace dressform::metrics {
namespace {

using Eigen::Vector2d;

constexpr double kStep_m = 0.003;        // across the body
constexpr double kInnermostArm = 0.055;  // of the stature: nearer to the middle no arm begins
constexpr double kRise_m = 0.015;        // by which a section thickens again where an arm follows
constexpr double kLevel_m = 0.002;
constexpr double kBridge = 0.6;  // of the trunk's thickness: what is thicker is shoulder

Vector2d mean_of(const std::vector<Vector2d>& points) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

std::vector<SectionLine> closed_by_size(std::vector<SectionLine> lines) {
  std::stable_sort(lines.begin(), lines.end(), [](const SectionLine& a, const SectionLine& b) {
    return std::abs(signed_area(a.points)) > std::abs(signed_area(b.points));
  });
  return lines;
}

// The part of a polygon on the side where normal.p <= offset (Sutherland and Hodgman, CACM 1974).
std::vector<Vector2d> clipped(const std::vector<Vector2d>& polygon, const Vector2d& normal, double offset) {
  std::vector<Vector2d> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double a = normal.dot(from) - offset, b = normal.dot(to) - offset;
    if (a <= 0) result.push_back(from);
    if ((a <= 0) != (b <= 0)) result.push_back(from + a / (a - b) * (to - from));
  }
  return result;
}

// Where an arm begins beside the trunk.
struct ArmCut {
  double aside = 0, bridge = 0;  // distance from the middle; thickness over the trunk's
};
std::optional<ArmCut> arm_cut(const std::vector<SectionLine>& trunk, const BodyAxes& axes, double sign) {
  double thickest = 0, thinnest = std::numeric_limits<double>::infinity(), at = 0;
  for (double aside = 0; aside < 0.4 * axes.stature; aside += kStep_m) {
    const double thickness = thickness_at(trunk, axes, sign * aside);
    thickest = std::max(thickest, thickness);
    if (aside < kInnermostArm * axes.stature) continue;
    if (thickness <= 0) return {};
    if (thickness < thinnest - kLevel_m) thinnest = thickness, at = aside;  // the inner end of a level bridge
    if (thickness > thinnest + kRise_m && thinnest < kBridge * thickest) return ArmCut{at, thinnest / thickest};
  }
  return {};
}

}  // namespace

double signed_area(const std::vector<Vector2d>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

std::vector<SectionLine> horizontal_section(const Mesh& mesh, double y) {
  // A point of the section lies on an edge; each crossed triangle joins two of them.
  std::map<std::pair<int, int>, int> point_of_edge;
  std::vector<Vector2d> points;
  std::vector<std::array<int, 2>> neighbours;
  const auto point_on = [&](int a, int b) {
    const auto [found, fresh] = point_of_edge.emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (fresh) {
      const Vector3d &p = mesh.vertices[found->first.first], &q = mesh.vertices[found->first.second];
      const Vector3d at = p + (q - p) * ((y - p.y()) / (q.y() - p.y()));
      points.push_back({at.x(), at.z()});
      neighbours.push_back({-1, -1});
    }
    return found->second;
  };
  const auto join = [&](int a, int b) {
    for (auto [from, to] : {std::pair(a, b), std::pair(b, a)}) neighbours[from][neighbours[from][0] >= 0] = to;
  };
  for (const auto& t : mesh.triangles) {
    int ends[2], count = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if ((mesh.vertices[a].y() >= y) != (mesh.vertices[b].y() >= y)) ends[count++] = point_on(a, b);
    }
    if (count == 2) join(ends[0], ends[1]);
  }
  std::vector<SectionLine> lines;
  std::vector<bool> used(points.size(), false);
  const auto walk = [&](int start, bool closed) {
    SectionLine line;
    line.closed = closed;
    for (int at = start; at >= 0 && !used[at];) {
      used[at] = true;
      line.points.push_back(points[at]);
      const auto& next = neighbours[at];
      at = next[0] >= 0 && !used[next[0]] ? next[0] : next[1];
    }
    lines.push_back(line);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!used[i] && neighbours[i][1] < 0) walk(static_cast<int>(i), false);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!used[i]) walk(static_cast<int>(i), true);
  return lines;
}

double hull_girth_m(const std::vector<Vector2d>& points) {
  if (points.empty()) return 0;
  std::vector<Vector2d> sorted = points, hull;
  std::sort(sorted.begin(), sorted.end(),
            [](const Vector2d& a, const Vector2d& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
  const auto extend = [&](const Vector2d& point, std::size_t least) {  // Andrew's monotone chain
    while (hull.size() > least) {
      const Vector2d u = hull.back() - hull[hull.size() - 2], w = point - hull.back();
      if (u.x() * w.y() - u.y() * w.x() > 0) break;
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const auto& point : sorted) extend(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = sorted.rbegin() + 1; point != sorted.rend(); ++point) extend(*point, lower);
  double girth = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) girth += (hull[(i + 1) % hull.size()] - hull[i]).norm();
  return girth;
}

std::optional<BodyAxes> body_axes(const Mesh& body) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& t : body.triangles)
    for (int k = 0; k < 3; ++k) {
      low = std::min(low, body.vertices[t[k]].y());
      high = std::max(high, body.vertices[t[k]].y());
    }
  BodyAxes axes;
  axes.low_y = low;
  axes.stature = high - low;
  if (body.triangles.empty() || !(axes.stature > 0)) return {};
  Vector2d side = Vector2d::Zero(), middle = Vector2d::Zero();
  int levels = 0;
  for (double part = 0.15; part < 0.325; part += 0.025) {
    const auto lines = closed_by_size(horizontal_section(body, low + part * axes.stature));
    if (lines.size() < 2 || !lines[0].closed || !lines[1].closed) continue;
    if (std::abs(signed_area(lines[1].points)) < 0.5 * std::abs(signed_area(lines[0].points))) continue;
    const Vector2d a = mean_of(lines[0].points), b = mean_of(lines[1].points);
    side += (b - a).dot(side) < 0 ? Vector2d(a - b) : Vector2d(b - a);
    middle += (a + b) / 2;
    ++levels;
  }
  if (levels < 3 || side.norm() < 1e-6) return {};
  axes.side = side.normalized();
  axes.middle = middle / levels;
  return axes;
}

double thickness_at(const std::vector<SectionLine>& lines, const BodyAxes& axes, double aside) {
  const Vector2d forward(-axes.side.y(), axes.side.x());
  std::vector<double> crossings;
  for (const auto& line : lines)
    for (std::size_t i = 0; line.closed && i < line.points.size(); ++i) {
      const Vector2d from = line.points[i] - axes.middle, to = line.points[(i + 1) % line.points.size()] - axes.middle;
      const double a = axes.side.dot(from) - aside, b = axes.side.dot(to) - aside;
      if ((a < 0) != (b < 0)) crossings.push_back(forward.dot(from + a / (a - b) * (to - from)));
    }
  std::sort(crossings.begin(), crossings.end());
  double thickness = 0;
  for (std::size_t i = 1; i < crossings.size(); i += 2) thickness += crossings[i] - crossings[i - 1];
  return thickness;
}

TrunkSection trunk_section(const std::vector<SectionLine>& lines, const BodyAxes& axes) {
  TrunkSection result;
  if (lines.empty()) return result;
  const auto sorted = closed_by_size(lines);
  for (std::size_t i = 1; i < sorted.size(); ++i) result.limbs.push_back(sorted[i].points);
  result.outline = sorted[0].points;
  for (const double sign : {1.0, -1.0}) {
    const auto cut = arm_cut({sorted[0]}, axes, sign);
    if (!cut) continue;
    const Vector2d normal = sign * axes.side;
    const double offset = normal.dot(axes.middle) + cut->aside;
    result.limbs.push_back(clipped(sorted[0].points, -normal, -offset));
    result.outline = clipped(result.outline, normal, offset);
    result.bridge = std::max(result.bridge, cut->bridge);
  }
  for (const auto& point : result.outline)
    result.half_breadth = std::max(result.half_breadth, std::abs(axes.side.dot(point - axes.middle)));
  return result;
}

}  // namespace dressform::metrics
