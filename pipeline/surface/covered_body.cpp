#include "pipeline/surface/covered_body.h"

#include <algorithm>
#include <cmath>

#include "pipeline/geometry/submesh.h"
#include "pipeline/surface/leg_tube.h"

namespace dressform {
namespace {

constexpr double kForkSeam_m = 0.02;  // legs come apart this far below the crotch
constexpr double kBeyond_m = 0.04;    // body kept past the caps, so that the surface runs straight up to them

// Height of an arm's axis at Limb::along, or of its root if that is lower.
double lowest_of_arm(const Limb& arm, double along) {
  return std::min(arm.root.y(), arm.root.y() + arm.direction.y() * along);
}

std::vector<char> kept_triangles(const MeshQuery& naked, const Landmarks& limbs, const GarmentLayout& layout,
                                 double past_m) {
  const Mesh& body = naked.mesh();
  std::vector<char> kept(body.triangles.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Vector3i& t = body.triangles[i];
    const Vector3d centre = (body.vertices[t[0]] + body.vertices[t[1]] + body.vertices[t[2]]) / 3;
    const BodyPart part = limbs.triangle_parts[i];
    kept[i] = centre.y() < layout.top_y + past_m;
    if (is_arm(part)) {
      const LimbCover& arm = layout.arms[side_of(part)];
      kept[i] = arm.covered && limbs.arm(side_of(part))->along(centre) < arm.end_m + past_m;
    } else if (is_leg(part) && layout.forked()) {
      kept[i] = kept[i] && centre.y() > layout.legs[side_of(part)].end_y - past_m;
    } else {
      kept[i] = kept[i] && centre.y() > layout.bottom_y - past_m;
    }
  }
  return kept;
}

}  // namespace

CoveredBody::CoveredBody(const MeshQuery& naked, const Landmarks& limbs, const GarmentLayout& layout, double margin_m)
    : naked_(naked),
      limbs_(limbs),
      layout_(layout),
      margin_m_(margin_m),
      kept_(kept_triangles(naked, limbs, layout, margin_m + kBeyond_m)),
      covered_(submesh(naked.mesh(), kept_)),
      tube_(!layout.forked() && layout.bottom_y < limbs.crotch_y + kTubeAboveCrotch_m
                ? leg_tube(naked.mesh(), limbs, layout.bottom_y - margin_m - kBeyond_m)
                : Mesh{}) {
  const auto part_is = [&](auto&& wanted) {
    std::vector<char> part(kept_.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = kept_[i] && wanted(limbs.triangle_parts[i]);
    return MeshQuery(submesh(naked.mesh(), part));
  };
  for (int side = 0; side < 2; ++side) {
    if (!layout.arms[side].covered) continue;
    const BodyPart arm = arm_part(side);
    const Limb& limb = *limbs.arm(side);
    forks_.push_back({part_is([arm](BodyPart part) { return part == arm; }),
                      part_is([arm](BodyPart part) { return part != arm; }),
                      limb.root + limb.direction * layout.arms[side].free_m, limb.direction});
  }
  if (layout.forked())
    forks_.push_back({part_is([](BodyPart part) { return part == BodyPart::left_leg; }),
                      part_is([](BodyPart part) { return part == BodyPart::right_leg; }),
                      Vector3d(0, limbs.crotch_y - kForkSeam_m, 0), -Vector3d::UnitY()});
  bool first = true;
  for (const Mesh* mesh : {&covered_.mesh(), &tube_.mesh()})
    for (const Vector3d& v : mesh->vertices) {
      low_ = first ? v : Vector3d(low_.cwiseMin(v));
      high_ = first ? v : Vector3d(high_.cwiseMax(v));
      first = false;
    }
  const double bottom = layout.forked() ? std::min(layout.legs[0].end_y, layout.legs[1].end_y) : layout.bottom_y;
  double lowest = std::min(bottom, layout.bottom_y) - margin_m;
  for (int side = 0; side < 2; ++side)  // long sleeves reach below the hem
    if (layout.arms[side].covered)
      lowest = std::min(lowest, lowest_of_arm(*limbs.arm(side), layout.arms[side].end_m + margin_m) - margin_m);
  low_.y() = std::max(low_.y(), lowest);
  high_.y() = std::min(high_.y(), layout.top_y + margin_m);
}

double CoveredBody::signed_distance(const Vector3d& point, double bound_m) const {
  const auto closest = covered_.closest(point, bound_m);
  double distance = closest.distance;
  if (closest.triangle >= 0 && covered_.signed_distance(point, closest) < 0) {
    // Inside, unless it lies in a limb that was taken away.
    const auto nearest = naked_.closest(point, distance + 1e-6);
    if (nearest.triangle < 0 || kept_[nearest.triangle]) distance = -distance;
  }
  const auto tube = tube_.closest(point, std::min(bound_m, std::abs(distance)));
  return tube.triangle < 0 ? distance : std::min(distance, tube_.signed_distance(point, tube));
}

double CoveredBody::from_crevice(const Vector3d& point, double bound_m) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Fork& fork : forks_) {
    if ((point - fork.from).dot(fork.direction) < 0) continue;
    const double limb = fork.limb.closest(point).distance;
    if (!std::isfinite(limb)) continue;
    const double other = fork.other.closest(point, limb + 2 * bound_m).distance;
    if (std::isfinite(other)) nearest = std::min(nearest, std::abs(limb - other) / 2);
  }
  return nearest;
}

double CoveredBody::beyond_ends(const Vector3d& point) const {
  double bottom = layout_.bottom_y;
  if (layout_.forked() && point.y() < limbs_.crotch_y) {
    const Vector3d left = limbs_.left_leg->root, right = limbs_.right_leg->root;
    bottom = layout_.legs[(point - (left + right) / 2).dot(limbs_.left) > 0 ? 0 : 1].end_y;
  }
  const double beyond = std::max(point.y() - layout_.top_y, bottom - point.y());
  for (int side = 0; side < 2; ++side) {
    if (!layout_.arms[side].covered) continue;
    const double past = limbs_.arm(side)->along(point) - layout_.arms[side].end_m;
    if (past < -margin_m_ - kBeyond_m && point.y() > bottom) continue;
    // A sleeve ends at its cuff, also where that is lower than the hem.
    const int triangle = naked_.closest(point).triangle;
    const BodyPart arm = arm_part(side);
    if (triangle >= 0 && limbs_.triangle_parts[triangle] == arm) return past - margin_m_;
  }
  return beyond - margin_m_;
}

}  // namespace dressform
