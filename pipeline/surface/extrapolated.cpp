#include "pipeline/surface/extrapolated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "pipeline/geometry/sector.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr int kSectors = 48;          // round an end
constexpr double kEnds_m = 0.12;      // sectors may end this much before the garment's end: hems slant
constexpr double kBand_m = 0.025;     // points this close to their sector's end are carried on
constexpr double kStep_m = 0.006;     // between made-up points
constexpr double kNear_m = 0.03;      // normals are averaged over points this close ...
constexpr double kAlike = 0.8;        // ... and their cosine
constexpr double kLeastAlong = 0.75;  // of the cloth's own way, along the limb: steeper ends are not carried on
constexpr float kWeight = 0.3f;

// One end of a garment: along grows towards it.
struct End {
  Vector3d origin, axis, zero;
  double along = 0;  // of the last points

  double along_of(const Vector3d& p) const { return (p - origin).dot(axis); }
  int sector(const Vector3d& p) const {
    const Vector3d d = p - origin;
    return sector_of(std::atan2(d.dot(axis.cross(zero)), d.dot(zero)), kSectors);
  }
};

End make_end(const Vector3d& origin, const Vector3d& axis, const Vector3d& front) {
  return {origin, axis, (front - axis * axis.dot(front)).normalized(), 0};
}

enum EndName { left_cuff, right_cuff, upper, lower, left_lower, right_lower, kEndCount };

std::array<End, kEndCount> ends_of(const GarmentLayout& layout, const Landmarks& limbs) {
  std::array<End, kEndCount> ends;
  const Vector3d up = Vector3d::UnitY();
  for (int side = 0; side < 2; ++side) {
    if (limbs.arm(side) && layout.arms[side].covered) {
      ends[side] = make_end(limbs.arm(side)->root, limbs.arm(side)->direction, limbs.front);
      ends[side].along = layout.arms[side].end_m;
    }
    if (limbs.leg(side)) {
      const Limb& leg = *limbs.leg(side);
      const double down = leg.direction.y() < -0.1 ? (layout.legs[side].end_y - leg.root.y()) / leg.direction.y() : 0;
      ends[left_lower + side] = make_end(leg.root + down * leg.direction, -up, limbs.front);
    }
  }
  ends[upper] = make_end(Vector3d(limbs.neck.x(), layout.top_y, limbs.neck.z()), up, limbs.front);
  ends[lower] = make_end(Vector3d(limbs.neck.x(), layout.bottom_y, limbs.neck.z()), -up, limbs.front);
  return ends;
}

// Whether a point of a sleeve lies on the side of the trunk: points there may be of either, or of what bridges them.
bool faces_trunk(const End& cuff, int side, const Vector3d& p, const Landmarks& limbs) {
  constexpr double kFacing = 0.6;  // cosine
  Vector3d out = p - cuff.origin;
  out -= cuff.axis * cuff.axis.dot(out);
  return -out.dot(limbs.outwards(side)) > kFacing * out.norm();
}

// The end that a point may be near; kEndCount for none.
int end_near(const Vector3d& p, const GarmentLayout& layout, const MeshQuery& naked, const Landmarks& limbs) {
  const BodyPart part = limbs.part_of(naked.closest(p).triangle);
  if (is_arm(part)) {
    return layout.arms[side_of(part)].covered ? side_of(part) : kEndCount;
  }
  if (!layout.upper() && p.y() > layout.top_y - kEnds_m) return upper;
  if (!layout.forked()) return lower;
  if (p.y() > limbs.crotch_y) return kEndCount;
  return (p - limbs.hips()).dot(limbs.left) > 0 ? left_lower : right_lower;
}

// The normal of the cloth at one of a sector's last points, averaged over what lies alike beside it.
Vector3d mean_normal(const GarmentCloud& cloud, const std::vector<int>& band, int at) {
  Vector3d sum = Vector3d::Zero();
  for (const int other : band)
    if ((cloud.cloud.points[other] - cloud.cloud.points[at]).norm() < kNear_m &&
        cloud.cloud.normals[other].dot(cloud.cloud.normals[at]) > kAlike)
      sum += cloud.weights[other] * cloud.cloud.normals[other];
  return sum.normalized();
}

// Carries the last points of one sector on. `indices`: of the cloud, in that sector.
void carry(const GarmentCloud& cloud, const End& end, const std::vector<int>& indices, double reach_m,
           GarmentCloud& result) {
  constexpr std::size_t kFewest = 4;
  std::vector<double> along;
  for (const int i : indices) along.push_back(end.along_of(cloud.cloud.points[i]));
  if (along.size() < kFewest) return;
  const double last = nth_value(along, along.size() - 2);  // but for a stray
  if (last < end.along - kEnds_m) return;
  std::vector<int> band;
  for (const int i : indices)
    if (end.along_of(cloud.cloud.points[i]) > last - kBand_m) band.push_back(i);
  for (const int i : band) {
    const Vector3d normal = mean_normal(cloud, band, i), way = end.axis - normal * normal.dot(end.axis);
    if (!(way.norm() > kLeastAlong)) continue;
    const Vector3d& p = cloud.cloud.points[i];
    const Vector3d per_along = way / way.dot(end.axis);
    for (double to = last + kStep_m; to < last + reach_m; to += kStep_m) {
      result.cloud.points.push_back(p + per_along * (to - end.along_of(p)));
      result.cloud.normals.push_back(normal);
      result.weights.push_back(kWeight * cloud.weights[i]);
    }
  }
}

}  // namespace

GarmentCloud extrapolated(const GarmentCloud& cloud, const GarmentLayout& layout, const MeshQuery& naked,
                          const Landmarks& limbs, double reach_m) {
  const auto ends = ends_of(layout, limbs);
  std::array<std::vector<std::vector<int>>, kEndCount> sectors;
  for (auto& each : sectors) each.resize(kSectors);
  for (std::size_t i = 0; i < cloud.cloud.points.size(); ++i) {
    const Vector3d& p = cloud.cloud.points[i];
    const int end = end_near(p, layout, naked, limbs);
    if (end == kEndCount || ends[end].along_of(p) < ends[end].along - kEnds_m - kBand_m) continue;
    if (end <= right_cuff && faces_trunk(ends[end], end, p, limbs)) continue;
    sectors[end][ends[end].sector(p)].push_back(static_cast<int>(i));
  }
  GarmentCloud result;
  result.cloud.points = cloud.cloud.points;
  result.cloud.normals = cloud.cloud.normals;
  result.weights = cloud.weights;
  for (int end = 0; end < kEndCount; ++end)
    for (const auto& indices : sectors[end]) carry(cloud, ends[end], indices, reach_m, result);
  return result;
}

}  // namespace dressform
