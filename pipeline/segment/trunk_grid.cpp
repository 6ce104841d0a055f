#include "pipeline/segment/trunk_grid.h"

#include <algorithm>
#include <cmath>

#include "pipeline/geometry/sector.h"

namespace dressform {

TrunkGrid::TrunkGrid(const Landmarks& limbs) : axis(limbs.neck), floor_y(limbs.floor_y) {
  if (limbs.left_leg && limbs.right_leg) axis = limbs.hips();
  rows = std::max(8, static_cast<int>(std::ceil((limbs.top_y - limbs.floor_y + 0.1) / kRow_m)));
}

int TrunkGrid::column(const cv::Vec3f& place) const {
  return sector_of(std::atan2(place[0] - axis.x(), place[2] - axis.z()), kColumns);
}

int TrunkGrid::row(const cv::Vec3f& place) const {
  return std::clamp(static_cast<int>((place[1] - floor_y) / kRow_m), 0, rows - 1);
}

}  // namespace dressform
