#pragma once
#include <string>
#include <vector>

#include "pipeline/garment/garment_layout.h"
#include "scenes/mesh.h"

namespace dressform {

// What points of cloth (model frame) say of legs, height by height: a skirt spans the gap between them, trousers leave
// a gap or a valley there, on both sides as far as both are seen. The lower two thirds of the heights vote.
struct LegVotes {
  int spans = 0, parts = 0;  // heights below the crotch at which the cloth spans the legs, or leaves them apart
  bool part() const { return parts > spans; }
  double sure() const { return spans + parts > 0 ? std::abs(parts - spans) / static_cast<double>(spans + parts) : 0; }
};
LegVotes leg_votes(const std::vector<Vector3d>& points, const Landmarks& landmarks);

// A kind, and how sure it is, 0-1.
struct FoundKind {
  std::string kind;
  double sure = 0;
};

// The layout of that kind: its legs are covered where it has any.
GarmentLayout with_kind(GarmentLayout layout, const FoundKind& found, const Landmarks& landmarks);

// "trousers" or "skirt" from points of the lower garment. A body whose legs are not apart wears a skirt.
FoundKind bottom_kind(const std::vector<Vector3d>& points, const Landmarks& landmarks);

// "dress" or "shirt" from points of the only garment, which covers the chest: a dress hangs well below the crotch.
FoundKind top_kind(const std::vector<Vector3d>& points, const Landmarks& landmarks);

// "trousers" where a bottom's closed surface comes apart into two legs below the crotch, "skirt" where it stays one;
// `before` where it does either or ends too soon to tell.
FoundKind closed_bottom_kind(const Mesh& closed, const Landmarks& landmarks, const FoundKind& before);

}  // namespace dressform
