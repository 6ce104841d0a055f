#pragma once
#include <limits>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/garment/garment_layout.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {

// The part of the body that a garment goes round: the naked body without the limbs that stick out of it, and for
// garments that are not forked a convex tube round both legs.
class CoveredBody {
 public:
  CoveredBody(const MeshQuery& naked, const Landmarks& limbs, const GarmentLayout& layout, double margin_m);

  // Distance to its surface, metres, negative inside. Positive infinity if nothing is covered, or if nothing lies
  // within `bound_m`.
  double signed_distance(const Vector3d& point, double bound_m = std::numeric_limits<double>::infinity()) const;

  // Distance beyond the ends of the garment plus the margin: positive there, negative within.
  double beyond_ends(const Vector3d& point) const;

  // How far the point is from the middle between an arm and the trunk below the armhole, or between the legs below the
  // crotch: zero half way, positive elsewhere; infinity above, or where that is more than `bound_m`. What touches there
  // is two sheets, and has to come apart for the ends to be cut off one by one.
  double from_crevice(const Vector3d& point, double bound_m) const;

  // Box of the covered body, cut at the ends.
  const Vector3d& low() const { return low_; }
  const Vector3d& high() const { return high_; }

 private:
  const MeshQuery& naked_;
  const Landmarks& limbs_;
  GarmentLayout layout_;
  double margin_m_;
  std::vector<char> kept_;  // of the naked triangles
  MeshQuery covered_, tube_;
  struct Fork {
    MeshQuery limb, other;
    Vector3d from, direction;  // only beyond the plane through `from`
  };
  std::vector<Fork> forks_;
  Vector3d low_ = Vector3d::Zero(), high_ = Vector3d::Zero();
};

}  // namespace dressform
