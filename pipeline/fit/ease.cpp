#include "pipeline/fit/ease.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

constexpr int kLevels = 90;        // over the trunk
constexpr double kLastPart = 3.8;  // just below the armpits: above, cloth of trunk and sleeves is one
constexpr double kFade_m = 0.015;
constexpr double kWholeTurn = 0.95;           // of a turn: lines that come so far round close
constexpr double kWidestGap = M_PI / 3;       // under an arm cloth of the trunk may be missing
constexpr std::size_t kFewestCrossings = 20;  // of cloth and level, to measure a girth
constexpr double kNearAxis_m = 0.03;          // of the trunk: there is no way out from there

// A connected line of the garment's section: its points, and its pieces from point to point.
struct Line {
  std::vector<Vector3d> points;
  std::vector<std::pair<int, int>> pieces;
};

std::vector<Line> section_lines(const Mesh& garment, double y) {
  std::map<std::pair<int, int>, int> point_of_edge;
  std::vector<Vector3d> points;
  std::vector<std::pair<int, int>> pieces;
  for (const auto& t : garment.triangles) {
    int ends[2] = {-1, -1};  // where the section enters the triangle, and leaves it
    for (int k = 0; k < 3; ++k) {
      const Vector3d &a = garment.vertices[t[k]], &b = garment.vertices[t[(k + 1) % 3]];
      if ((a.y() < y) == (b.y() < y)) continue;
      const auto [at, fresh] =
          point_of_edge.emplace(std::minmax(t[k], t[(k + 1) % 3]), static_cast<int>(points.size()));
      if (fresh) points.push_back(a + (y - a.y()) / (b.y() - a.y()) * (b - a));
      ends[a.y() < y] = at->second;
    }
    if (ends[0] >= 0) pieces.emplace_back(ends[0], ends[1]);
  }
  DisjointSets sets(points.size());
  for (const auto& [from, to] : pieces) sets.join(from, to);
  std::vector<Line> lines;
  std::vector<int> line_of(points.size(), -1), place(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    int& line = line_of[sets.root(static_cast<int>(i))];
    if (line < 0) line = static_cast<int>(lines.size()), lines.emplace_back();
    place[i] = static_cast<int>(lines[line].points.size());
    lines[line].points.push_back(points[i]);
  }
  for (const auto& [from, to] : pieces) lines[line_of[sets.root(from)]].pieces.emplace_back(place[from], place[to]);
  return lines;
}

// Whether the line closes round the point, seen from above.
bool goes_round(const Line& line, const Vector3d& centre) {
  double turn = 0;
  for (const auto& [from, to] : line.pieces) {
    const Vector3d a = line.points[from] - centre, b = line.points[to] - centre;
    turn += std::atan2(a.x() * b.z() - a.z() * b.x(), a.x() * b.x() + a.z() * b.z());
  }
  return std::abs(turn) > kWholeTurn * 2 * M_PI;
}

Vector3d middle_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

bool of_limb(const Vector3d& point, const TrunkOutline& body) {
  const double to_trunk = horizontal_distance(point, body.trunk.points);
  return std::any_of(body.limbs.begin(), body.limbs.end(),
                     [&](const auto& limb) { return horizontal_distance(point, limb) < to_trunk; });
}

cv::Point2f seen_from_above(const Vector3d& p) { return {static_cast<float>(p.x()), static_cast<float>(p.z())}; }

// Where the trunk's cloth crosses the height, (x, z): lines that close round the trunk alone. Where a sleeve and the
// trunk's cloth are one line, or the line is open: all but lines round an arm alone and points nearer to an arm.
std::vector<cv::Point2f> crossings(const Mesh& garment, const TrunkOutline& body, double y) {
  std::vector<cv::Point2f> alone, near;
  for (const Line& line : section_lines(garment, y)) {
    const bool round_trunk = goes_round(line, body.trunk.centroid);
    const bool round_limb = std::any_of(body.limbs.begin(), body.limbs.end(),
                                        [&](const auto& limb) { return goes_round(line, middle_of(limb)); });
    for (const Vector3d& p : line.points) {
      if (round_trunk && !round_limb) alone.push_back(seen_from_above(p));
      if ((round_trunk || !round_limb) && !of_limb(p, body)) near.push_back(seen_from_above(p));
    }
  }
  return alone.empty() ? near : alone;
}

// No gap wider than kWidestGap.
bool goes_round(const std::vector<cv::Point2f>& points, const Vector3d& centre) {
  std::vector<double> angles;
  for (const auto& p : points) angles.push_back(std::atan2(p.y - centre.z(), p.x - centre.x()));
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * M_PI - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap < kWidestGap;
}

// Tape girth of cloth minus body at height y, m; nothing where the cloth does not go round.
std::optional<double> ease_at(const Mesh& garment, const StandingBody& body, double y) {
  const TrunkOutline outline = body.outline_at(y);
  if (outline.trunk.points.empty()) return {};
  const auto points = crossings(garment, outline, body.sections.y(body.sections.level(y)));
  if (points.size() < kFewestCrossings || !goes_round(points, outline.trunk.centroid)) return {};
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  return cv::arcLength(hull, true) - tape_girth(outline.trunk);
}

// Height at part t of the trunk: 0 crotch, 1 hip, 2 waist, 3 chest, 4 armpit.
double tape_height(const StandingBody& body, double t) {
  const Landmarks& marks = body.landmarks;
  return height_at({marks.crotch_y, marks.hip_y, marks.waist_y, marks.chest_y, marks.armpit_y}, t);
}

// Moves the cloth away from the trunk's axis by what is wanted near its height, faded over the height.
void widen(const StandingBody& user, const std::vector<double>& weights,
           const std::vector<std::pair<double, double>>& wanted, Mesh& cloth) {
  const auto change_at = [&](double y) {
    double sum = 0, total = 1e-3;  // a little weight for "no change", which wins away from the measured levels
    for (const auto& [height, change] : wanted) {
      const double d = (height - y) / kFade_m, weight = std::exp(-0.5 * d * d);
      sum += weight * change;
      total += weight;
    }
    return sum / total;
  };
  tbb::parallel_for(std::size_t{0}, cloth.vertices.size(), [&](std::size_t v) {
    Vector3d& p = cloth.vertices[v];
    const SectionLoop* loop = user.trunk_loop(p.y());
    Vector3d out = loop ? Vector3d(p - loop->centroid) : Vector3d::Zero();
    out.y() = 0;
    if (weights[v] > 0 && out.norm() > kNearAxis_m) p += weights[v] * change_at(p.y()) * out.normalized();
  });
}

}  // namespace

std::vector<Vector3d> with_ease_kept(const Mesh& before, const StandingBody& naked, const Mesh& fitted,
                                     const StandingBody& user, const std::vector<double>& weights, double largest_m,
                                     int rounds) {
  const auto part = [](int level) { return kLastPart * (level + 0.5) / kLevels; };
  std::vector<std::optional<double>> was(kLevels), is(kLevels);
  tbb::parallel_for(0, kLevels, [&](int i) { was[i] = ease_at(before, naked, tape_height(naked, part(i))); });
  Mesh result = fitted;
  for (int round = 0; round < rounds; ++round) {
    tbb::parallel_for(0, kLevels, [&](int i) { is[i] = ease_at(result, user, tape_height(user, part(i))); });
    std::vector<std::pair<double, double>> wanted;  // height on the user, change of radius
    for (int i = 0; i < kLevels; ++i)
      if (was[i] && is[i])
        wanted.emplace_back(tape_height(user, part(i)),
                            std::clamp((*was[i] - *is[i]) / (2 * M_PI), -largest_m, largest_m));
    if (wanted.empty()) break;
    widen(user, weights, wanted, result);
  }
  return result.vertices;
}

}  // namespace dressform
