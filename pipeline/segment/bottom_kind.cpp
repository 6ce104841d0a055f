#include "pipeline/segment/bottom_kind.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dressform {
namespace {

constexpr double kSlab_m = 0.03;    // height of one vote
constexpr double kMiddle = 0.25;    // half width of the middle, in parts of the distance of a leg from it
constexpr double kValley_m = 0.02;  // the middle lies this much deeper than the legs: trousers
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

}  // namespace

std::string bottom_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs) {
  if (!limbs.left_leg || !limbs.right_leg) return "skirt";  // legs that are not apart
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
  int spans = 0, parts = 0;
  for (Slab& slab : slabs) {
    // A skirt falls in folds, too: a valley on one side says nothing where the other side spans the legs.
    bool known = false, span = false;
    for (const int back : {0, 1}) {
      if (!slab.legs[back].known()) continue;
      known = true;
      span |= slab.middle[back].known() && slab.middle[back].median() > slab.legs[back].median() - kValley_m;
    }
    if (known) ++(span ? spans : parts);
  }
  return spans > parts ? "skirt" : "trousers";
}

}  // namespace dressform
