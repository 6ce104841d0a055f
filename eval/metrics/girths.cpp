#include "eval/metrics/girths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dressform::metrics {
namespace {

using Eigen::Vector2d;
constexpr double kStep_m = 0.005;

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

// The trunk's girth over the height, and where it ends: legs below, arms above.
class Trunk {
 public:
  Trunk(const Mesh& body, const BodyAxes& axes) : axes_(axes), first_y_(axes.low_y + 0.38 * axes.stature) {
    const int count = static_cast<int>(0.52 * axes.stature / kStep_m);
    for (int i = 0; i < count; ++i) {
      const auto lines = horizontal_section(body, first_y_ + i * kStep_m);
      const TrunkSection section = trunk_section(lines, axes);
      girth_m_.push_back(hull_girth_m(section.outline));
      bridge_.push_back(section.bridge);
      half_breadth_.push_back(section.half_breadth);
      legs_.push_back(thighs_apart(lines));
    }
  }

  double part(double of_stature) const { return axes_.low_y + of_stature * axes_.stature; }

  // Mean girth over 5 cm about a height.
  double girth(double y) const {
    double sum = 0;
    int count = 0;
    for (int i = index(y - 0.025); i <= index(y + 0.025); ++i, ++count) sum += girth_m_[i];
    return sum / count;
  }

  // The highest level with a gap or a deep notch between thighs; where people have theirs if thighs are one piece.
  double crotch() const {
    for (int i = index(part(0.56)); i > 0; --i)
      if (legs_[i]) return first_y_ + i * kStep_m;
    return part(0.475);
  }

  // Where an arm's joint to the trunk becomes a third as thick as the trunk, or where the trunk becomes much wider at
  // once (arms held out level).
  std::optional<double> armpit() const {
    constexpr double kJoint = 0.3;
    const int lag = static_cast<int>(0.03 / kStep_m);
    for (int i = index(part(0.64)); i < static_cast<int>(girth_m_.size()); ++i) {
      if (bridge_[i] > kJoint) {
        const double rise = bridge_[i] - bridge_[i - 1];
        return first_y_ + (i - std::clamp((bridge_[i] - kJoint) / rise, 0.0, 1.0)) * kStep_m;
      }
      if (bridge_[i] == 0 && half_breadth_[i] > 1.25 * half_breadth_[i - lag]) return first_y_ + (i - 1) * kStep_m;
    }
    return {};
  }

 private:
  int index(double y) const {
    return std::clamp(static_cast<int>(std::lround((y - first_y_) / kStep_m)), 0,
                      static_cast<int>(girth_m_.size()) - 1);
  }

  // Less than half as thick in the middle as in the thighs: a web between thighs, or their touching, is no crotch.
  bool thighs_apart(const std::vector<SectionLine>& lines) const {
    const double aside = 0.055 * axes_.stature;
    const double thigh = std::min(thickness_at(lines, axes_, aside), thickness_at(lines, axes_, -aside));
    double middle = std::numeric_limits<double>::infinity();
    for (double off = -0.015; off <= 0.0151; off += 0.003)
      middle = std::min(middle, thickness_at(lines, axes_, off * axes_.stature));
    return middle < 0.45 * thigh;
  }

  BodyAxes axes_;
  double first_y_;
  std::vector<double> girth_m_, bridge_, half_breadth_;
  std::vector<char> legs_;
};

// Height between `low` and `high` with the largest (sign 1) or least (sign -1) girth, counted less by `pull` times the
// square of how far it is, as a part of the span from `from` to `to`, from `usual`.
struct Search {
  double from, to;
  double low, high;
  double sign, usual, pull;
};
double extreme(const Trunk& trunk, const Search& search) {
  double best_y = 0, best = -std::numeric_limits<double>::infinity();
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = search.low + (search.high - search.low) * i / kSteps;
    const double off = (y - search.from) / (search.to - search.from) - search.usual;
    const double score = search.sign * trunk.girth(y) * (1 - search.sign * search.pull * off * off);
    if (score <= best) continue;
    best = score;
    best_y = y;
  }
  return best_y;
}

TapeLevels::Level level_of(const Mesh& body, const BodyAxes& axes, double y) {
  TrunkSection section = trunk_section(horizontal_section(body, y), axes);
  TapeLevels::Level level{y, hull_girth_m(section.outline), Vector2d::Zero(), {}, {}};
  if (!section.outline.empty()) level.center = centroid(section.outline);
  level.torso = std::move(section.outline);
  level.limbs = std::move(section.limbs);
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

bool encloses(const std::vector<Vector2d>& polygon, const Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

bool encloses_a_limb(const std::vector<Vector2d>& polygon, const TapeLevels::Level& level) {
  return std::any_of(level.limbs.begin(), level.limbs.end(),
                     [&](const auto& limb) { return encloses(polygon, centroid(limb)); });
}

// The torso's cloth and nothing else.
bool is_round_torso_alone(const SectionLine& line, const TapeLevels::Level& level) {
  return line.closed && encloses(line.points, level.center) && !encloses_a_limb(line.points, level);
}

// A sleeve of its own: it goes round a limb and not round the torso, however close to the torso it hangs.
bool is_sleeve(const SectionLine& line, const TapeLevels::Level& level) {
  return line.closed && !encloses(line.points, level.center) && encloses_a_limb(line.points, level);
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

std::optional<TapeLevels> tape_levels(const Mesh& body) {
  const auto axes = body_axes(body);
  if (!axes || axes->stature < 0.6) return {};
  const Trunk trunk(body, *axes);
  const double crotch = trunk.crotch();
  const auto armpit = trunk.armpit();
  if (!armpit || *armpit < crotch + 0.12 * axes->stature) return {};
  const auto between = [&](double t) { return crotch + t * (*armpit - crotch); };
  const double waist = extreme(trunk, {crotch, *armpit, between(0.3), between(0.7), -1, 0.5, 8});
  const double lowest_hip = crotch + 0.04 * (waist - crotch), highest_hip = crotch + 0.5 * (waist - crotch);
  const double hip = extreme(trunk, {crotch, waist, lowest_hip, highest_hip, 1, 0.2, 0.5});
  const double highest_chest = *armpit - 0.028 * axes->stature, lowest_chest = waist + 0.45 * (*armpit - waist);
  const double chest = extreme(trunk, {waist, *armpit, lowest_chest, highest_chest, 1, 0.75, 0});
  TapeLevels levels;
  levels.waist = level_of(body, *axes, waist);
  levels.hip = level_of(body, *axes, hip);
  levels.chest = level_of(body, *axes, chest);
  levels.crotch_y = crotch;
  levels.armpit_y = *armpit;
  return levels;
}

std::optional<double> garment_girth_m(const Mesh& garment, const TapeLevels::Level& level) {
  std::vector<Vector2d> alone, near;
  for (const auto& line : horizontal_section(garment, level.y)) {
    if (is_round_torso_alone(line, level)) alone.insert(alone.end(), line.points.begin(), line.points.end());
    if (is_sleeve(line, level)) continue;
    const auto of_torso = points_of_torso(line.points, level);
    near.insert(near.end(), of_torso.begin(), of_torso.end());
  }
  if (!alone.empty()) return hull_girth_m(alone);
  if (near.empty() || angle_round(near, level.center) < 300) return {};
  return hull_girth_m(near);
}

}  // namespace dressform::metrics
