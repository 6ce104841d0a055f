#include "pipeline/fit/limbs_apart.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/geometry/sector.h"
#include "pipeline/geometry/submesh.h"
#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

constexpr double kStep_m = 0.005;   // between the heights at which a garment may part
constexpr double kLowest_m = 0.25;  // below the wearer's crotch or armpit no garment parts any more
constexpr int kSectors = 12;
constexpr int kSteps = 4;            // towards the own side
constexpr double kLeastSlope = 0.5;  // of the difference of the distances; at most 2, between the legs

// Connected pieces of the garment below a height: per vertex the least vertex of its piece, -1 above.
std::vector<int> pieces_below(const Mesh& garment, double y) {
  DisjointSets sets(garment.vertices.size());
  const auto below = [&](int v) { return garment.vertices[v].y() < y; };
  for (const auto& t : garment.triangles)
    for (int k = 0; k < 3; ++k)
      if (below(t[k]) && below(t[(k + 1) % 3])) sets.join(t[k], t[(k + 1) % 3]);
  std::vector<int> piece(garment.vertices.size(), -1);
  for (int v = 0; v < static_cast<int>(piece.size()); ++v)
    if (below(v)) piece[v] = sets.root(v);
  return piece;
}

struct Axis {
  Vector3d root, direction;
};
Axis axis_of(const Limb& limb) { return {limb.root, limb.direction}; }

// Of each piece, whether it has cloth in every direction from the axis.
std::vector<char> go_round(const Mesh& garment, const std::vector<int>& piece, const Axis& axis) {
  const Vector3d u = axis.direction.unitOrthogonal(), w = axis.direction.cross(u);
  std::vector<std::array<bool, kSectors>> seen(piece.size());
  for (std::size_t v = 0; v < piece.size(); ++v) {
    if (piece[v] < 0) continue;
    const Vector3d out = garment.vertices[v] - axis.root;
    seen[piece[v]][sector_of(std::atan2(out.dot(w), out.dot(u)), kSectors)] = true;
  }
  std::vector<char> result(piece.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = std::all_of(seen[i].begin(), seen[i].end(), [](bool one) { return one; });
  return result;
}

// 1 for pieces that go round the one axis alone, -1 for those that go round the other alone, below the first height
// from `top_y` down at which there are both.
ClothSides sides_of(const Mesh& garment, const Axis& one, const Axis& other, double top_y) {
  ClothSides sides(garment.vertices.size(), 0);
  for (double down = 0; down < kLowest_m; down += kStep_m) {
    const auto piece = pieces_below(garment, top_y - down);
    const auto round_one = go_round(garment, piece, one), round_other = go_round(garment, piece, other);
    bool any_one = false, any_other = false;
    for (std::size_t v = 0; v < sides.size(); ++v) {
      const bool is_one = piece[v] >= 0 && round_one[piece[v]], is_other = piece[v] >= 0 && round_other[piece[v]];
      sides[v] = static_cast<signed char>(is_one - is_other);
      any_one = any_one || sides[v] > 0;
      any_other = any_other || sides[v] < 0;
    }
    if (any_one && any_other) return sides;
  }
  return ClothSides(garment.vertices.size(), 0);
}

Mesh part_of(const StandingBody& body, const std::function<bool(BodyPart)>& wanted) {
  std::vector<char> kept;
  for (const BodyPart part : body.landmarks.triangle_parts) kept.push_back(wanted(part));
  return submesh(body.mesh, kept);
}

// Two parts of the user's body with cloth between them.
struct Neighbours {
  std::function<bool(BodyPart)> is_one, is_other;
  MeshQuery one, other;

  Neighbours(const StandingBody& user, std::function<bool(BodyPart)> first, std::function<bool(BodyPart)> second)
      : is_one(std::move(first)),
        is_other(std::move(second)),
        one(part_of(user, is_one)),
        other(part_of(user, is_other)) {}
};

void keep_apart(const ClothSides& sides, const Neighbours& parts, const StandingBody& user,
                const MeshQuery& user_surface, double gap_m, std::vector<Vector3d>& cloth) {
  if (parts.one.mesh().triangles.empty() || parts.other.mesh().triangles.empty()) return;
  tbb::parallel_for(std::size_t{0}, cloth.size(), [&](std::size_t v) {
    if (sides[v] == 0) return;
    const MeshQuery &own = sides[v] > 0 ? parts.one : parts.other, &other = sides[v] > 0 ? parts.other : parts.one;
    const auto &is_own = sides[v] > 0 ? parts.is_one : parts.is_other,
               &is_other = sides[v] > 0 ? parts.is_other : parts.is_one;
    for (int step = 0; step < kSteps; ++step) {
      // Newton's step along the difference of the distances to the two parts, which is zero midway. Distances are
      // signed by the whole body, which is closed where a part by itself is not.
      const Vector3d p = cloth[v];
      const auto to_own = own.closest(p), to_other = other.closest(p), to_body = user_surface.closest(p);
      const bool inside = user_surface.signed_distance(p, to_body) < 0;
      const BodyPart nearest = user.landmarks.part_of(to_body.triangle);
      const double from_own = inside && is_own(nearest) ? -to_own.distance : to_own.distance;
      const double from_other = inside && is_other(nearest) ? -to_other.distance : to_other.distance;
      const double over = from_own - from_other + 2 * gap_m;
      if (over <= 0) return;
      Vector3d slope = Vector3d::Zero();
      if (to_own.distance > 1e-6) slope += (p - to_own.point) / from_own;
      if (to_other.distance > 1e-6) slope -= (p - to_other.point) / from_other;
      if (slope.squaredNorm() < kLeastSlope * kLeastSlope) return;  // seen from there both lie the same way
      cloth[v] -= over / slope.squaredNorm() * slope;
    }
  });
}

}  // namespace

ClothLimbs limbs_of_cloth(const Mesh& garment, const GarmentLayout& layout, const StandingBody& wearer) {
  constexpr double kAbove_m = 0.03;  // of a fork as the body's sections tell it
  const ClothSides none(garment.vertices.size(), 0);
  ClothLimbs result{none, {none, none}};
  const Landmarks& limbs = wearer.landmarks;
  if (layout.forked() && limbs.left_leg && limbs.right_leg)
    result.legs =
        sides_of(garment, axis_of(*limbs.left_leg), axis_of(*limbs.right_leg), wearer.landmarks.crotch_y + kAbove_m);
  for (int side = 0; side < 2; ++side)
    if (const Limb* arm = limbs.arm(side); arm && layout.arms[side].covered)
      result.arms[side] = sides_of(garment, axis_of(*arm), {wearer.landmarks.axis, Vector3d::UnitY()},
                                   wearer.landmarks.armpit_y + kAbove_m);
  return result;
}

std::vector<Vector3d> limbs_kept_apart(const Mesh& fitted, const ClothLimbs& limbs, const StandingBody& user,
                                       const MeshQuery& user_surface, double gap_m) {
  std::vector<Vector3d> result = fitted.vertices;
  const auto any = [](const ClothSides& sides) {
    return std::any_of(sides.begin(), sides.end(), [](signed char side) { return side != 0; });
  };
  if (any(limbs.legs))
    keep_apart(limbs.legs,
               Neighbours(
                   user, [](BodyPart part) { return part == BodyPart::left_leg; },
                   [](BodyPart part) { return part == BodyPart::right_leg; }),
               user, user_surface, gap_m, result);
  for (int side = 0; side < 2; ++side) {
    if (!any(limbs.arms[side])) continue;
    const BodyPart arm = side == 0 ? BodyPart::left_arm : BodyPart::right_arm;
    keep_apart(limbs.arms[side],
               Neighbours(
                   user, [arm](BodyPart part) { return part == arm; },
                   [](BodyPart part) { return part == BodyPart::torso || is_leg(part); }),
               user, user_surface, gap_m, result);
  }
  return result;
}

}  // namespace dressform
