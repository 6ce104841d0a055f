#include "pipeline/segment/trunk_grid.h"

#include <algorithm>
#include <cmath>

namespace dressform {

TrunkGrid::TrunkGrid(const BodyLimbs& limbs) : axis(limbs.neck), floor_y(limbs.floor_y) {
  if (limbs.left_leg && limbs.right_leg) axis = (limbs.left_leg->root + limbs.right_leg->root) / 2;
  rows = std::max(8, static_cast<int>(std::ceil((limbs.top_y - limbs.floor_y + 0.1) / kRow_m)));
}

int TrunkGrid::column(const cv::Vec3f& place) const {
  const double angle = std::atan2(place[0] - axis.x(), place[2] - axis.z()) + M_PI;
  return std::clamp(static_cast<int>(angle / (2 * M_PI) * kColumns), 0, kColumns - 1);
}

int TrunkGrid::row(const cv::Vec3f& place) const {
  return std::clamp(static_cast<int>((place[1] - floor_y) / kRow_m), 0, rows - 1);
}

}  // namespace dressform
