#pragma once
#include <optional>

#include "synthetic/garments/tube.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// The gap between a sleeve and the trunk below the armhole's lowest point. Cloth of a sleeve and of the trunk that hang
// into one another there do not grow together: each is pressed back to its own side of the surface midway between arm
// and trunk.
class Underarm {
 public:
  // trunk, arm: the bare body's, the arm's s running down from the shoulder and its angle pi towards the trunk; side:
  // +1 left, -1 right; cuff_s: where along the arm the sleeve ends.
  Underarm(const Tube& trunk, const Tube& arm, double side, double cuff_s);

  // Cut open along the gap. Where arm and trunk leave no room for two layers above the cuff the solid stays whole.
  Field parted(const Field& field) const;

  // The trunk's cloth, or the sleeve's, without what lies on the other's side of the gap: a shred there that `parted`
  // leaves whole, as where a bent arm's wide sleeve hangs before the trunk.
  Field trunk_side(const Field& trunk_cloth) const;
  Field arm_side(const Field& sleeve) const;

  // Positive where a place is nearer to the arm than to the trunk.
  double nearer_to_arm(const Vector3d& point) const { return trunk_.field(point) - arm_.field(point); }

  // Height of the armhole's lowest point; absent where there is no room.
  std::optional<double> start_y() const { return start_y_; }

 private:
  // The layer cut below the armpit where `gap`, of the distances to trunk and arm, is positive.
  template <class Gap>
  Field cut(const Field& layer, const Gap& gap) const;

  Tube trunk_, arm_;
  double side_;
  std::optional<double> start_y_;
};

}  // namespace dressform
