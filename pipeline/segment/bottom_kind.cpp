#include "pipeline/segment/bottom_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace dressform {
namespace {

constexpr double kSlab_m = 0.03;    // height of one vote
constexpr double kMiddle = 0.25;    // half width of the middle, in parts of the distance of a leg from it
constexpr double kValley_m = 0.02;  // the middle lies this much deeper than the legs: trousers
constexpr double kThick = 0.6;      // of the thickness over the legs has cloth that spans them
constexpr double kDeep = 0.4;       // of it: a valley that one side alone tells
constexpr std::size_t kLeastPoints = 3;

// How far forward a group of points lies: the median; absent for a few points.
struct Front {
  std::vector<double> values;
  bool known() const { return values.size() >= kLeastPoints; }
  double median() {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }
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
    legs += slab.legs[side].median();
    if (!slab.middle[side].known()) continue;
    middle += slab.middle[side].median();
    span |= slab.middle[side].median() > slab.legs[side].median() - kValley_m;
  }
  if (span || (known > 0 && middle > kThick * legs)) return true;
  if (known == 2 || (known == 1 && middle < kDeep * legs)) return false;
  return {};
}

}  // namespace

LegVotes leg_votes(const std::vector<Vector3d>& points, const BodyLimbs& limbs) {
  LegVotes votes;
  if (!limbs.left_leg || !limbs.right_leg) return votes;
  const double height = limbs.top_y - limbs.floor_y, start = limbs.crotch_y - 0.03 * height;
  std::vector<Slab> slabs(static_cast<std::size_t>(std::max(1.0, std::ceil((start - limbs.floor_y) / kSlab_m))));
  const Limb &left = *limbs.left_leg, &right = *limbs.right_leg;
  const auto at_height = [](const Limb& leg, double y) {
    const double drop = leg.direction.y() < -0.1 ? (y - leg.root.y()) / leg.direction.y() : 0;
    return Vector3d(leg.root + drop * leg.direction);
  };
  for (const Vector3d& p : points) {
    if (p.y() >= start || p.y() <= limbs.floor_y) continue;
    const Vector3d a = at_height(left, p.y()), b = at_height(right, p.y()), center = (a + b) / 2;
    const double half = std::max(0.03, (a - b).norm() / 2);
    const double side = std::abs((p - center).dot(limbs.left)) / half, forward = (p - center).dot(limbs.front);
    const int back = forward < 0;
    Slab& slab = slabs[std::min(slabs.size() - 1, static_cast<std::size_t>((start - p.y()) / kSlab_m))];
    if (side < kMiddle) slab.middle[back].values.push_back(std::abs(forward));
    if (side > 0.75 && side < 1.25) slab.legs[back].values.push_back(std::abs(forward));
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

std::string bottom_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs) {
  if (!limbs.left_leg || !limbs.right_leg) return "skirt";  // legs that are not apart
  const LegVotes votes = leg_votes(points, limbs);
  return votes.parts > votes.spans ? "trousers" : "skirt";  // trousers have to show legs
}

std::string top_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs) {
  constexpr double kBelowCrotch = 0.05;  // of the body's height
  std::vector<double> heights;
  for (const Vector3d& p : points) heights.push_back(p.y());
  if (heights.empty()) return "shirt";
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 100);
  std::nth_element(heights.begin(), low, heights.end());
  return *low < limbs.crotch_y - kBelowCrotch * (limbs.top_y - limbs.floor_y) ? "dress" : "shirt";
}

}  // namespace dressform
