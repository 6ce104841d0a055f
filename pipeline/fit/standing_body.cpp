#include "pipeline/fit/standing_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "pipeline/body/section_depth.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr int kBins = 180;  // of 2 degrees

// Crotch height over stature, mean .482 and correlation .86 in ANSUR II: beyond these bounds it is not the crotch.
constexpr double kLowestCrotch = 0.435, kMeanCrotch = 0.475;
constexpr double kLowestFork = 0.30;  // to which thighs may be one piece
constexpr double kLowestArmpit = 0.69, kHighestArmpit = 0.80;

double mean_girth_near(const StandingBody& body, double y) {
  double sum = 0;
  int count = 0;
  for (double d = -0.02; d < 0.021; d += 0.01)
    if (const auto outline = body.outline_at(y + d); !outline.trunk.points.empty())
      sum += tape_girth(outline.trunk), ++count;
  return count ? sum / count : std::numeric_limits<double>::infinity();
}

// Mean of the trunk's centroids over the heights from `low` to `high`; throws InputError where there is no trunk.
Vector3d trunk_axis(const StandingBody& body, double low, double high) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (double y = low; y < high; y += body.sections.step)
    if (const SectionLoop* loop = body.trunk_loop(y)) sum += loop->centroid, ++count;
  if (count == 0) throw InputError("body", "found no trunk between crotch and armpits; expected a standing body, y up");
  return sum / count;
}

// The crotch by topology, or higher, where the section is two thighs that only touch.
double find_crotch(const StandingBody& body) {
  const double floor = body.limbs.floor_y, lowest = floor + kLowestCrotch * body.stature;
  const double highest = floor + kHighestCrotch * body.stature;
  const double by_topology = body.limbs.crotch_y;
  for (double y = highest; y > std::max(lowest, by_topology); y -= body.sections.step) {
    const SectionLoop* loop = body.trunk_loop(y);
    if (loop && thighs_that_touch(*loop, body.limbs, body.stature)) return y;
  }
  return by_topology < lowest ? floor + kMeanCrotch * body.stature : std::min(by_topology, highest);
}

// Where arm and trunk first touch, found from a little above, where their joint becomes a third as thick as the trunk:
// a web of the surface in the armpit moves the touch, but not the joint. By topology where the sections show no joint.
double find_armpit(const StandingBody& body) {
  constexpr double kJoint = 0.3, kAboveTouch = 0.015;  // of the trunk's thickness; of the stature
  const double floor = body.limbs.floor_y;
  double before = 0;
  for (int level = body.sections.level(floor + 0.64 * body.stature);
       body.sections.y(level) < floor + 0.86 * body.stature; ++level) {
    const double joint = body.outline_at(body.sections.y(level)).joint;
    if (joint > kJoint)
      return body.sections.y(level) - std::clamp((joint - kJoint) / (joint - before), 0.0, 1.0) * body.sections.step -
             kAboveTouch * body.stature;
    before = joint;
  }
  return body.limbs.armpit_y;
}

// The narrowest height of the trunk; the pull to its middle decides where a belly leaves no waist.
double find_waist(const StandingBody& body) {
  double best_y = 0, best = std::numeric_limits<double>::infinity();
  for (double t = 0.3; t <= 0.7; t += 0.01) {
    const double y = body.crotch_y + t * (body.armpit_y - body.crotch_y);
    const double cost = mean_girth_near(body, y) * (1 + 8 * (t - 0.5) * (t - 0.5));
    if (cost >= best) continue;
    best = cost;
    best_y = y;
  }
  return best_y > 0 ? best_y : 0.5 * (body.crotch_y + body.armpit_y);
}

// The widest height between crotch and waist; the pull to where hips are decides where there is none.
double find_hip(const StandingBody& body) {
  double best_y = 0, best = 0;
  for (double t = 0.04; t <= 0.5; t += 0.01) {
    const double y = body.crotch_y + t * (body.waist_y - body.crotch_y), girth = mean_girth_near(body, y);
    const double score = std::isfinite(girth) ? girth * (1 - 0.5 * (t - 0.2) * (t - 0.2)) : 0;
    if (score <= best) continue;
    best = score;
    best_y = y;
  }
  return best_y > 0 ? best_y : body.crotch_y + 0.25 * (body.waist_y - body.crotch_y);
}

// The widest height from half-way between waist and armpit to just below the armpit.
double find_chest(const StandingBody& body) {
  const double highest = body.armpit_y - 0.013 * body.stature, lowest = 0.55 * body.waist_y + 0.45 * body.armpit_y;
  double best_y = highest, best = 0;
  for (int i = 0; i <= 40; ++i) {
    const double y = highest - (highest - lowest) * i / 40, girth = mean_girth_near(body, y);
    if (!std::isfinite(girth) || girth <= best) continue;
    best = girth;
    best_y = y;
  }
  return best_y;
}

// The narrowest height between shoulders and chin; the pull to where necks are keeps it off the crown.
double find_neck(const StandingBody& body) {
  double best_part = 0.862, best = std::numeric_limits<double>::infinity();
  for (double part = 0.825; part <= 0.905; part += 0.005) {
    const double girth = mean_girth_near(body, body.limbs.floor_y + part * body.stature);
    const double cost = girth * (1 + 60 * (part - 0.862) * (part - 0.862));
    if (cost >= best) continue;
    best = cost;
    best_part = part;
  }
  return body.limbs.floor_y + best_part * body.stature;
}

// How far the body reaches from the axis in each direction (0 = front), at one part of the stature: the trunk's loop,
// or the two legs below it. Over its mean, so that girth does not matter.
std::vector<double> outline(const StandingBody& body, double part) {
  std::vector<double> reach(kBins, 0);
  const double y = body.limbs.floor_y + part * body.stature;
  const int level = body.sections.level(y);
  if (level < 0) return reach;
  const auto& loops = body.sections.levels[level];
  const std::size_t used = std::min<std::size_t>(loops.size(), y < body.crotch_y ? 2 : 1);
  for (int bin = 0; bin < kBins; ++bin) {
    const Vector3d direction = body.direction(2 * M_PI * bin / kBins);
    for (std::size_t i = 0; i < used; ++i)
      for (const auto& point : loops[i].points) reach[bin] = std::max(reach[bin], direction.dot(point - body.axis));
  }
  double mean = 0;
  for (double r : reach) mean += r / kBins;
  for (double& r : reach) r = mean > 0 ? r / mean : 0;
  return reach;
}

using Outlines = std::vector<std::vector<double>>;

Outlines outlines(const StandingBody& body, double from, double to) {
  Outlines result;
  for (double part = from; part <= to; part += 0.012) result.push_back(outline(body, part));
  return result;
}

// Mean squared difference with the second body turned by each number of bins.
std::vector<double> differences(const Outlines& a, const Outlines& b) {
  std::vector<double> result(kBins, 0);
  const std::size_t levels = std::min(a.size(), b.size());
  for (int turn = 0; turn < kBins; ++turn)
    for (std::size_t level = 0; level < levels; ++level)
      for (int i = 0; i < kBins; ++i) {
        const double d = a[level][i] - b[level][(i + turn) % kBins];
        result[turn] += d * d / static_cast<double>(levels * kBins);
      }
  return result;
}

int apart(int a, int b) {
  const int d = std::abs(a - b) % kBins;
  return std::min(d, kBins - d);
}

void turn_front(StandingBody& body, double angle) {
  const Vector3d front = body.direction(angle);
  body.limbs.front = front;
  body.limbs.left = Vector3d::UnitY().cross(front);
}

// The turn, in bins with a fraction, nearest to `coarse` at which the trunks agree best; where they are as round as
// columns, the rest of the body decides.
double refined_turn(const StandingBody& naked, const StandingBody& user, const std::vector<double>& whole, int coarse) {
  auto cost = differences(outlines(naked, 0.52, 0.70), outlines(user, 0.52, 0.70));
  for (int turn = 0; turn < kBins; ++turn) cost[turn] += 0.1 * whole[turn];
  const auto at = [&](int turn) { return cost[(turn + 2 * kBins) % kBins]; };
  int best = coarse;
  for (int turn = coarse - 7; turn <= coarse + 7; ++turn)
    if (at(turn) < at(best)) best = turn;
  const double before = at(best - 1), here = at(best), after = at(best + 1), bend = before - 2 * here + after;
  const double fraction = bend > 1e-15 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
  return best + fraction;
}

}  // namespace

double tape_girth(const SectionLoop& loop) {
  std::vector<cv::Point2f> points, hull;
  for (const auto& p : loop.points) points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.z()));
  cv::convexHull(points, hull);
  return cv::arcLength(hull, true);
}

const SectionLoop* StandingBody::trunk_loop(double y) const {
  if (y < sections.first_y || sections.levels.empty()) return nullptr;
  const auto& level = sections.levels[sections.level(y)];
  return level.empty() ? nullptr : &level[0];
}

double height_at(const std::vector<double>& marks, double t) {
  const int i = std::clamp(static_cast<int>(t), 0, static_cast<int>(marks.size()) - 2);
  return marks[i] + (t - i) * (marks[i + 1] - marks[i]);
}

TrunkOutline StandingBody::outline_at(double y) const {
  if (y < sections.first_y || sections.levels.empty()) return {};
  return trunk_outline(sections.levels[sections.level(y)], axis, limbs.left, stature);
}

StandingBody analyse_body(const Mesh& mesh, const std::optional<Vector3d>& front_hint) {
  StandingBody body;
  body.mesh = mesh;
  body.sections = horizontal_sections(mesh);
  body.limbs = find_limbs(mesh, body.sections, front_hint);
  const double floor = body.limbs.floor_y;
  body.stature = body.limbs.top_y - floor;
  body.axis = trunk_axis(body, floor + 0.52 * body.stature, floor + 0.64 * body.stature);
  body.crotch_y = find_crotch(body);
  body.armpit_y =
      std::clamp(find_armpit(body), floor + kLowestArmpit * body.stature, floor + kHighestArmpit * body.stature);
  body.neck_y = find_neck(body);
  body.waist_y = find_waist(body);
  body.hip_y = find_hip(body);
  body.chest_y = find_chest(body);
  // Hips and waist are told from where the legs part; cloth between thighs that are one piece can only be below it.
  body.crotch_y = std::min(body.crotch_y, std::max(body.limbs.crotch_y, floor + kLowestFork * body.stature));
  body.axis = trunk_axis(body, body.crotch_y, body.armpit_y);
  return body;
}

FacingUser face_alike(const StandingBody& naked, const Mesh& user) {
  FacingUser result{analyse_body(user), 0, false};
  auto cost = differences(outlines(naked, 0.52, 0.90), outlines(result.user, 0.52, 0.90));
  const auto feet = differences(outlines(naked, 0.02, 0.08), outlines(result.user, 0.02, 0.08));
  for (int turn = 0; turn < kBins; ++turn) cost[turn] += 0.2 * feet[turn];
  const int best = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  double second = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kBins; ++turn)
    if (apart(turn, best) > 20) second = std::min(second, cost[turn]);
  result.confident = second > 1.15 * cost[best];
  const double turn = refined_turn(naked, result.user, cost, best);
  const double angle = turn * 2 * M_PI / kBins;
  result.turn_deg = std::remainder(angle, 2 * M_PI) * 180 / M_PI;
  if (std::abs(result.turn_deg) > 90) {  // left and right were taken for one another
    const Vector3d front = result.user.direction(angle);
    result.user = analyse_body(user, front);
    turn_front(result.user, std::atan2(front.dot(result.user.limbs.left), front.dot(result.user.limbs.front)));
  } else {
    turn_front(result.user, angle);
  }
  return result;
}

}  // namespace dressform
