#include "pipeline/fit/legs_apart.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "pipeline/common/mesh_query.h"

namespace dressform {
namespace {

constexpr double kStep_m = 0.005;     // between the heights at which a garment may part
constexpr double kLowest_m = 0.25;    // below the wearer's crotch no garment parts any more
constexpr double kFewest = 0.2;       // a leg's vertices, of the other leg's
constexpr double kBetween_m = 0.025;  // of a leg's middle from the middle of both
constexpr int kSteps = 4;             // towards the own side
constexpr double kLeastSlope = 0.5;   // of the difference of the distances; at most 2, between the legs

// Connected pieces of the garment below a height: per vertex the least vertex of its piece, -1 above.
std::vector<int> pieces_below(const Mesh& garment, double y) {
  std::vector<int> root(garment.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto root_of = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const auto below = [&](int v) { return garment.vertices[v].y() < y; };
  for (const auto& t : garment.triangles)
    for (int k = 0; k < 3; ++k) {
      if (!below(t[k]) || !below(t[(k + 1) % 3])) continue;
      const int a = root_of(t[k]), b = root_of(t[(k + 1) % 3]);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> piece(root.size(), -1);
  for (std::size_t v = 0; v < piece.size(); ++v)
    if (below(static_cast<int>(v))) piece[v] = root_of(static_cast<int>(v));
  return piece;
}

struct Piece {
  double aside = 0;  // of its middle, to the left of the middle of the legs
  int count = 0;
};

std::vector<Piece> measured(const Mesh& garment, const std::vector<int>& piece, const StandingBody& wearer) {
  const Vector3d middle = wearer.limbs.hips();
  std::vector<Piece> pieces(piece.size());
  for (std::size_t v = 0; v < piece.size(); ++v) {
    if (piece[v] < 0) continue;
    Piece& own = pieces[piece[v]];
    own.aside += wearer.limbs.left.dot(garment.vertices[v] - middle);
    ++own.count;
  }
  for (Piece& each : pieces) each.aside /= std::max(1, each.count);
  return pieces;
}

// The largest piece of either side; nothing where the garment is still one piece round both legs.
std::optional<std::array<int, 2>> two_legs(const std::vector<Piece>& pieces) {
  std::array<int, 2> legs{-1, -1};
  for (int i = 0; i < static_cast<int>(pieces.size()); ++i) {
    int& best = legs[pieces[i].aside > 0 ? 0 : 1];
    if (pieces[i].count > 0 && (best < 0 || pieces[i].count > pieces[best].count)) best = i;
  }
  if (legs[0] < 0 || legs[1] < 0) return {};
  const Piece &left = pieces[legs[0]], &right = pieces[legs[1]];
  if (std::min(left.count, right.count) < kFewest * std::max(left.count, right.count)) return {};
  if (left.aside < kBetween_m || right.aside > -kBetween_m) return {};
  return legs;
}

Mesh leg_mesh(const StandingBody& body, BodyPart part) {
  Mesh result;
  result.vertices = body.mesh.vertices;
  for (std::size_t i = 0; i < body.mesh.triangles.size(); ++i)
    if (body.limbs.triangle_parts[i] == part) result.triangles.push_back(body.mesh.triangles[i]);
  return result;
}

}  // namespace

std::vector<int> leg_of_vertices(const Mesh& garment, const StandingBody& wearer) {
  std::vector<int> leg(garment.vertices.size(), -1);
  if (!wearer.limbs.left_leg || !wearer.limbs.right_leg) return leg;
  for (double down = -0.03; down < kLowest_m; down += kStep_m) {
    const auto piece = pieces_below(garment, wearer.crotch_y - down);
    const auto legs = two_legs(measured(garment, piece, wearer));
    if (!legs) continue;
    for (std::size_t v = 0; v < leg.size(); ++v)
      for (int side = 0; side < 2; ++side)
        if (piece[v] == (*legs)[side]) leg[v] = side;
    return leg;
  }
  return leg;
}

std::vector<Vector3d> legs_kept_apart(const Mesh& fitted, const std::vector<int>& leg, const StandingBody& user,
                                      double gap_m) {
  std::vector<Vector3d> result = fitted.vertices;
  const std::array<BodyPart, 2> parts{BodyPart::left_leg, BodyPart::right_leg};
  const std::array<MeshQuery, 2> legs{MeshQuery(leg_mesh(user, parts[0])), MeshQuery(leg_mesh(user, parts[1]))};
  if (legs[0].mesh().triangles.empty() || legs[1].mesh().triangles.empty()) return result;
  const MeshQuery body(user.mesh);
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t v) {
    if (leg[v] < 0) return;
    for (int step = 0; step < kSteps; ++step) {
      // Newton's step along the difference of the distances to the two legs, which is zero midway.
      const Vector3d p = result[v];
      const auto on_body = body.closest(p);
      const bool inside = body.signed_distance(p, on_body) < 0;
      std::array<double, 2> distance{};
      std::array<Vector3d, 2> away{Vector3d::Zero(), Vector3d::Zero()};  // unit, the way the distance grows
      for (int side = 0; side < 2; ++side) {
        const auto closest = legs[side].closest(p);
        // Signed by the whole body, which is closed where the leg by itself is not.
        distance[side] =
            inside && user.limbs.part_of(on_body.triangle) == parts[side] ? -closest.distance : closest.distance;
        if (closest.distance > 1e-6) away[side] = (p - closest.point) / distance[side];
      }
      const double over = distance[leg[v]] - distance[1 - leg[v]] + 2 * gap_m;
      if (over <= 0) return;
      const Vector3d slope = away[leg[v]] - away[1 - leg[v]];
      if (slope.squaredNorm() < kLeastSlope * kLeastSlope) return;  // seen from there the legs lie the same way
      result[v] -= over / slope.squaredNorm() * slope;
    }
  });
  return result;
}

}  // namespace dressform
