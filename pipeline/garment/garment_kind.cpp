#include "pipeline/garment/garment_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kSlab_m = 0.03;    // height of one vote
constexpr double kMiddle = 0.25;    // half width of the middle, in parts of the distance of a leg from it
constexpr double kValley_m = 0.02;  // the middle lies this much deeper than the legs: trousers
constexpr double kThick = 0.6;      // of the thickness over the legs has cloth that spans them
constexpr double kDeep = 0.4;       // of it: a valley that one side alone tells
constexpr std::size_t kLeastPoints = 3;
constexpr std::size_t kLowStrays = 100;   // one point of so many may lie below the garment
constexpr double kBelowFork = 0.03;       // of the stature: above, legs of trousers touch
constexpr double kLeg[2] = {0.75, 1.25};  // where a leg is, in parts of its distance from the middle
constexpr double kLeastHalf_m = 0.03;     // of the distance between the legs

// How far forward a group of points lies: the median; absent for a few points.
struct Front {
  std::vector<double> values;
  bool known() const { return values.size() >= kLeastPoints; }
  double middle() const { return median(values); }
};

struct Slab {
  std::array<Front, 2> middle, legs;  // in front, at the back
};

// A skirt falls in folds, and its middle need not be that of the legs: a valley on one side says nothing where the
// other side spans the legs, or where the cloth is nearly as thick there as over the legs. Where one side alone is
// seen, only a gap or a deep valley speaks for legs.
std::optional<bool> spans_legs(Slab& slab) {
  int known = 0;
  bool span = false;
  double middle = 0, legs = 0;
  for (const int side : {0, 1}) {
    if (!slab.legs[side].known()) continue;
    ++known;
    legs += slab.legs[side].middle();
    if (!slab.middle[side].known()) continue;
    middle += slab.middle[side].middle();
    span |= slab.middle[side].middle() > slab.legs[side].middle() - kValley_m;
  }
  if (span || (known > 0 && middle > kThick * legs)) return true;
  if (known == 2 || (known == 1 && middle < kDeep * legs)) return false;
  return {};
}

}  // namespace

LegVotes leg_votes(const std::vector<Vector3d>& points, const Landmarks& landmarks) {
  LegVotes votes;
  if (!landmarks.left_leg || !landmarks.right_leg) return votes;
  const double start = landmarks.crotch_y - kBelowFork * landmarks.stature;
  std::vector<Slab> slabs(static_cast<std::size_t>(std::max(1.0, std::ceil((start - landmarks.floor_y) / kSlab_m))));
  const Limb &left = *landmarks.left_leg, &right = *landmarks.right_leg;
  const auto at_height = [](const Limb& leg, double y) {
    const double drop = leg.direction.y() < -0.1 ? (y - leg.root.y()) / leg.direction.y() : 0;
    return Vector3d(leg.root + drop * leg.direction);
  };
  for (const Vector3d& p : points) {
    if (p.y() >= start || p.y() <= landmarks.floor_y) continue;
    const Vector3d a = at_height(left, p.y()), b = at_height(right, p.y()), center = (a + b) / 2;
    const double half = std::max(kLeastHalf_m, (a - b).norm() / 2);
    const double side = std::abs((p - center).dot(landmarks.left)) / half, forward = (p - center).dot(landmarks.front);
    const int back = forward < 0;
    Slab& slab = slabs[std::min(slabs.size() - 1, static_cast<std::size_t>((start - p.y()) / kSlab_m))];
    if (side < kMiddle) slab.middle[back].values.push_back(std::abs(forward));
    if (side > kLeg[0] && side < kLeg[1]) slab.legs[back].values.push_back(std::abs(forward));
  }
  // Just below the crotch legs of trousers touch: the lower part of the garment has the say.
  std::vector<bool> heard;  // whether the cloth spans the legs, upwards
  for (auto slab = slabs.rbegin(); slab != slabs.rend(); ++slab)
    if (const auto span = spans_legs(*slab)) heard.push_back(*span);
  heard.resize((2 * heard.size() + 2) / 3);
  votes.spans = static_cast<int>(std::count(heard.begin(), heard.end(), true));
  votes.parts = static_cast<int>(heard.size()) - votes.spans;
  return votes;
}

GarmentLayout with_kind(GarmentLayout layout, const FoundKind& found, const Landmarks& landmarks) {
  layout.kind = found.kind;
  layout.sure_kind = found.sure;
  for (int side = 0; side < 2; ++side) layout.legs[side].covered = landmarks.leg(side) && layout.forked();
  return layout;
}

FoundKind bottom_kind(const std::vector<Vector3d>& points, const Landmarks& landmarks) {
  if (!landmarks.left_leg || !landmarks.right_leg) return {"skirt", 0};  // legs that are not apart
  const LegVotes votes = leg_votes(points, landmarks);
  return {votes.part() ? "trousers" : "skirt", votes.sure()};  // trousers have to show legs
}

FoundKind top_kind(const std::vector<Vector3d>& points, const Landmarks& landmarks) {
  constexpr double kBelowCrotch = 0.05;  // of the body's height
  std::vector<double> heights;
  for (const Vector3d& p : points) heights.push_back(p.y());
  if (heights.empty()) return {"shirt", 0};
  const std::size_t strays = heights.size() / kLowStrays;
  const double hand = kBelowCrotch * landmarks.stature,
               below = landmarks.crotch_y - nth_value(std::move(heights), strays);
  return {below > hand ? "dress" : "shirt", std::clamp(std::abs(below - hand) / hand, 0.0, 1.0)};
}

FoundKind closed_bottom_kind(const Mesh& closed, const Landmarks& landmarks, const FoundKind& before) {
  constexpr double kFork_m = 0.03;    // legs come apart at most this far below the crotch
  constexpr double kEnd_m = 0.08;     // a hem's folds may come apart as well
  constexpr double kLeastPart = 0.2;  // a leg's section against the other's
  constexpr double kAll = 0.9;        // of the levels
  constexpr int kFewestLevels = 3;
  const Sections sections = horizontal_sections(closed);
  int forked = 0, whole = 0;
  for (int i = 0; i < static_cast<int>(sections.levels.size()); ++i) {
    const auto& loops = sections.levels[i];
    if (loops.empty() || sections.y(i) > landmarks.crotch_y - kFork_m || sections.y(i) < sections.first_y + kEnd_m)
      continue;
    ++(loops.size() > 1 && loops[1].area_m2 > kLeastPart * loops[0].area_m2 ? forked : whole);
  }
  const int levels = forked + whole;
  if (levels < kFewestLevels) return before;
  if (forked >= kAll * levels) return {"trousers", 1};
  if (whole >= kAll * levels) return {"skirt", 1};
  return before;
}

}  // namespace dressform
