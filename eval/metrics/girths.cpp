#include "eval/metrics/girths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace dressform::metrics {
namespace {

using Eigen::Vector2d;
constexpr double kStep_m = 0.01;

struct Slice {
  double y = 0, girth_m = 0;
  Vector2d center = Vector2d::Zero();
  std::vector<double> areas;  // of all its lines, largest first
};

double signed_area(const std::vector<Vector2d>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

Vector2d centroid(const std::vector<Vector2d>& points) {
  const double area = signed_area(points);
  if (std::abs(area) < 1e-12) return points.front();
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    sum += (a + b) * (a.x() * b.y() - a.y() * b.x());
  }
  return sum / (6 * area);
}

std::optional<Slice> slice_at(const Mesh& body, double y) {
  Slice slice;
  slice.y = y;
  double largest = 0;
  for (const auto& line : horizontal_section(body, y)) {
    const double area = std::abs(signed_area(line.points));
    slice.areas.push_back(area);
    if (area <= largest) continue;
    largest = area;
    slice.girth_m = hull_girth_m(line.points);
    slice.center = centroid(line.points);
  }
  std::sort(slice.areas.rbegin(), slice.areas.rend());
  if (largest <= 0) return {};
  return slice;
}

std::vector<Slice> slices_of(const Mesh& body) {
  double low = 1e9, high = -1e9;
  for (const auto& t : body.triangles)
    for (int k = 0; k < 3; ++k) {
      low = std::min(low, body.vertices[t[k]].y());
      high = std::max(high, body.vertices[t[k]].y());
    }
  std::vector<Slice> slices;
  for (double y = low + kStep_m; y < high; y += kStep_m)
    if (const auto slice = slice_at(body, y)) slices.push_back(*slice);
  return slices;
}

// Mean girth over 5 cm about slice i.
double smooth_girth(const std::vector<Slice>& slices, int i) {
  double sum = 0;
  int count = 0;
  for (int k = std::max(0, i - 2); k <= std::min<int>(slices.size() - 1, i + 2); ++k, ++count) sum += slices[k].girth_m;
  return sum / count;
}

// Slice of the largest (sign 1) or least (sign -1) smooth girth among [first, last].
int extreme(const std::vector<Slice>& slices, int first, int last, double sign) {
  int best = first;
  for (int i = first; i <= last; ++i)
    if (sign * smooth_girth(slices, i) > sign * smooth_girth(slices, best)) best = i;
  return best;
}

int crotch_of(const std::vector<Slice>& slices) {
  int crotch = -1;
  const int count = static_cast<int>(slices.size());
  for (int i = count * 3 / 10; i < count * 6 / 10; ++i)
    if (slices[i].areas.size() > 1 && slices[i].areas[1] > 0.5 * slices[i].areas[0]) crotch = i;
  return crotch;
}

int armpit_of(const std::vector<Slice>& slices, int crotch) {
  const int count = static_cast<int>(slices.size());
  for (int i = crotch + count / 7; i < count * 9 / 10; ++i)
    if (slices[i].girth_m > 1.08 * slices[i - 2].girth_m) return i - 1;
  return -1;
}

TapeLevels::Level level_of(const Mesh& body, const Slice& slice) {
  TapeLevels::Level level{slice.y, slice.girth_m, slice.center, {}, {}};
  for (auto& line : horizontal_section(body, slice.y)) level.limbs.push_back(std::move(line.points));
  const auto torso = std::max_element(level.limbs.begin(), level.limbs.end(), [](const auto& a, const auto& b) {
    return std::abs(signed_area(a)) < std::abs(signed_area(b));
  });
  level.torso = std::move(*torso);
  level.limbs.erase(torso);
  return level;
}

double distance(const Vector2d& point, const std::vector<Vector2d>& line) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector2d &from = line[i], side = line[(i + 1) % line.size()] - from;
    const double length = side.squaredNorm();
    const double along = length > 0 ? std::clamp((point - from).dot(side) / length, 0.0, 1.0) : 0;
    best = std::min(best, (from + along * side - point).norm());
  }
  return best;
}

std::vector<Vector2d> points_of_torso(const std::vector<Vector2d>& points, const TapeLevels::Level& level) {
  std::vector<Vector2d> kept;
  for (const auto& point : points) {
    const double to_torso = distance(point, level.torso);
    const bool of_limb = std::any_of(level.limbs.begin(), level.limbs.end(),
                                     [&](const auto& limb) { return distance(point, limb) < to_torso; });
    if (!of_limb) kept.push_back(point);
  }
  return kept;
}

double angle_round(const std::vector<Vector2d>& points, const Vector2d& center) {
  std::vector<double> angles;
  for (const auto& point : points) angles.push_back(std::atan2(point.y() - center.y(), point.x() - center.x()));
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * M_PI - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return (2 * M_PI - gap) * 180 / M_PI;
}

}  // namespace

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

std::optional<TapeLevels> tape_levels(const Mesh& body) {
  const std::vector<Slice> slices = slices_of(body);
  if (slices.size() < 60) return {};  // less than 60 cm tall
  const int crotch = crotch_of(slices);
  if (crotch < 0) return {};
  const int armpit = armpit_of(slices, crotch);
  if (armpit < 0) return {};
  const int span = armpit - crotch, waist = extreme(slices, crotch + span * 15 / 100, crotch + span * 85 / 100, -1);
  const int chest_top = armpit - static_cast<int>(slices.size()) / 50;
  TapeLevels levels;
  levels.waist = level_of(body, slices[waist]);
  levels.hip = level_of(body, slices[extreme(slices, std::min(crotch + 2, waist), waist, 1)]);
  levels.chest = level_of(body, slices[extreme(slices, std::min((waist + armpit) / 2, chest_top), chest_top, 1)]);
  levels.crotch_y = slices[crotch].y;
  levels.armpit_y = slices[armpit].y;
  return levels;
}

std::optional<double> garment_girth_m(const Mesh& garment, const TapeLevels::Level& level) {
  std::optional<double> girth;
  double least_gap = 0;
  for (const auto& line : horizontal_section(garment, level.y)) {
    const double round = angle_round(line.points, level.center);
    if (round < 300 || round <= least_gap) continue;
    least_gap = round;
    girth = hull_girth_m(points_of_torso(line.points, level));
  }
  return girth;
}

}  // namespace dressform::metrics
