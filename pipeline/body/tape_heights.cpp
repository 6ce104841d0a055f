#include "pipeline/body/tape_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/body/section_depth.h"

namespace dressform {
namespace {

// Of the stature, from the means and deviations of ANSUR II. The crotch: mean .482, correlation .86; beyond these
// bounds it is not the crotch.
constexpr double kLowestCrotch = 0.435, kMeanCrotch = 0.475;
constexpr double kLowestFork = 0.30;  // to which thighs may be one piece
constexpr double kLowestArmpit = 0.69, kHighestArmpit = 0.80;
constexpr double kArmpitFrom = 0.64, kArmpitTo = 0.86;  // searched for the joint of arm and trunk
constexpr double kNeckFrom = 0.825, kUsualNeck = 0.862, kNeckTo = 0.905, kNeckStep = 0.005;

constexpr double kBand_m = 0.02;  // girths are means over so much to either side
constexpr double kBandStep_m = 0.01;
constexpr double kStep = 0.01;  // of the way between two landmarks

// Pulls towards where people have the landmark, as a factor 1 +- pull (t - usual)^2 on girth: they decide where the
// trunk is as wide all along.
constexpr double kWaistPull = 8, kUsualWaist = 0.5, kWaistFrom = 0.3, kWaistTo = 0.7;  // crotch to armpit
constexpr double kHipPull = 0.5, kUsualHip = 0.2, kHipFrom = 0.04, kHipTo = 0.5;       // crotch to waist
constexpr double kNeckPull = 60;
constexpr double kHipWithoutTrunk = 0.25;
constexpr double kChestFrom = 0.45;       // waist to armpit
constexpr double kChestToArmpit = 0.013;  // of the stature
constexpr int kChestLevels = 40;

double mean_girth_near(const StandingBody& body, double y) {
  double sum = 0;
  int count = 0;
  for (double d = -kBand_m; d < kBand_m + kBandStep_m / 10; d += kBandStep_m)
    if (const auto outline = body.outline_at(y + d); !outline.trunk.points.empty())
      sum += tape_girth(outline.trunk), ++count;
  return count ? sum / count : std::numeric_limits<double>::infinity();
}

// The crotch by topology, or higher, where the section is two thighs that only touch.
double find_crotch(const StandingBody& body) {
  const Landmarks& marks = body.landmarks;
  const double lowest = marks.floor_y + kLowestCrotch * marks.stature;
  const double highest = marks.floor_y + kHighestCrotch * marks.stature;
  for (double y = highest; y > std::max(lowest, marks.crotch_y); y -= body.sections.step) {
    const SectionLoop* loop = body.trunk_loop(y);
    if (loop && thighs_that_touch(*loop, marks, marks.stature)) return y;
  }
  return marks.crotch_y < lowest ? marks.floor_y + kMeanCrotch * marks.stature : std::min(marks.crotch_y, highest);
}

// Where arm and trunk first touch, found from a little above, where their joint becomes a third as thick as the trunk:
// a web of the surface in the armpit moves the touch, but not the joint. By topology where the sections show no joint.
double find_armpit(const StandingBody& body) {
  constexpr double kJoint = 0.3, kAboveTouch = 0.015;  // of the trunk's thickness; of the stature
  const Landmarks& marks = body.landmarks;
  double before = 0;
  for (int level = body.sections.level(marks.floor_y + kArmpitFrom * marks.stature);
       body.sections.y(level) < marks.floor_y + kArmpitTo * marks.stature; ++level) {
    const double joint = body.outline_at(body.sections.y(level)).joint;
    if (joint > kJoint)
      return body.sections.y(level) - std::clamp((joint - kJoint) / (joint - before), 0.0, 1.0) * body.sections.step -
             kAboveTouch * marks.stature;
    before = joint;
  }
  return marks.armpit_y;
}

// The narrowest height of the trunk; the pull to its middle decides where a belly leaves no waist.
double find_waist(const StandingBody& body, const TapeHeights& tape) {
  double best_y = 0, best = std::numeric_limits<double>::infinity();
  for (double t = kWaistFrom; t <= kWaistTo; t += kStep) {
    const double y = tape.crotch_y + t * (tape.armpit_y - tape.crotch_y);
    const double cost = mean_girth_near(body, y) * (1 + kWaistPull * (t - kUsualWaist) * (t - kUsualWaist));
    if (cost >= best) continue;
    best = cost;
    best_y = y;
  }
  return best_y > 0 ? best_y : kUsualWaist * (tape.crotch_y + tape.armpit_y);
}

// The widest height between crotch and waist; the pull to where hips are decides where there is none.
double find_hip(const StandingBody& body, const TapeHeights& tape) {
  double best_y = 0, best = 0;
  for (double t = kHipFrom; t <= kHipTo; t += kStep) {
    const double y = tape.crotch_y + t * (tape.waist_y - tape.crotch_y), girth = mean_girth_near(body, y);
    const double score = std::isfinite(girth) ? girth * (1 - kHipPull * (t - kUsualHip) * (t - kUsualHip)) : 0;
    if (score <= best) continue;
    best = score;
    best_y = y;
  }
  return best_y > 0 ? best_y : tape.crotch_y + kHipWithoutTrunk * (tape.waist_y - tape.crotch_y);
}

// The widest height from half-way between waist and armpit to just below the armpit.
double find_chest(const StandingBody& body, const TapeHeights& tape) {
  const double highest = tape.armpit_y - kChestToArmpit * body.landmarks.stature;
  const double lowest = (1 - kChestFrom) * tape.waist_y + kChestFrom * tape.armpit_y;
  double best_y = highest, best = 0;
  for (int i = 0; i <= kChestLevels; ++i) {
    const double y = highest - (highest - lowest) * i / kChestLevels, girth = mean_girth_near(body, y);
    if (!std::isfinite(girth) || girth <= best) continue;
    best = girth;
    best_y = y;
  }
  return best_y;
}

// The narrowest height between shoulders and chin; the pull to where necks are keeps it off the crown.
double find_neck(const StandingBody& body) {
  double best_part = kUsualNeck, best = std::numeric_limits<double>::infinity();
  for (double part = kNeckFrom; part <= kNeckTo; part += kNeckStep) {
    const double girth = mean_girth_near(body, body.landmarks.floor_y + part * body.landmarks.stature);
    const double cost = girth * (1 + kNeckPull * (part - kUsualNeck) * (part - kUsualNeck));
    if (cost >= best) continue;
    best = cost;
    best_part = part;
  }
  return body.landmarks.floor_y + best_part * body.landmarks.stature;
}

}  // namespace

std::optional<Vector3d> trunk_axis(const StandingBody& body, double low, double high) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (double y = low; y < high; y += body.sections.step)
    if (const SectionLoop* loop = body.trunk_loop(y)) sum += loop->centroid, ++count;
  if (count == 0) return {};
  return Vector3d(sum / count);
}

TapeHeights tape_heights(const StandingBody& body) {
  const double floor = body.landmarks.floor_y, stature = body.landmarks.stature;
  TapeHeights tape;
  tape.crotch_y = find_crotch(body);
  tape.armpit_y = std::clamp(find_armpit(body), floor + kLowestArmpit * stature, floor + kHighestArmpit * stature);
  tape.neck_y = find_neck(body);
  tape.waist_y = find_waist(body, tape);
  tape.hip_y = find_hip(body, tape);
  tape.chest_y = find_chest(body, tape);
  // Hips and waist are told from where the legs part; cloth between thighs that are one piece can only be below it.
  tape.crotch_y = std::min(tape.crotch_y, std::max(body.landmarks.crotch_y, floor + kLowestFork * stature));
  return tape;
}

}  // namespace dressform
