#pragma once
#include <array>
#include <limits>
#include <string>

#include "pipeline/body/body_limbs.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/surface/garment_cloud.h"

namespace dressform {

// How far a garment reaches along the body, judged by where its points are. A little beyond these ends the closed
// surface is capped.
struct GarmentExtent {
  double top_y = 0, bottom_y = 0;              // neck or waist; hem or ankles
  std::array<bool, 2> has_arm{false, false};   // left, right
  std::array<double, 2> arm_along{0, 0};       // Limb::along of the cuffs
  std::array<double, 2> arm_free_along{0, 0};  // and of where sleeve and trunk come apart
  std::array<double, 2> leg_bottom_y{0, 0};    // left, right
  bool forked = false;                         // a tube round each leg; else one round both
};

// `garment`: "top" (may have sleeves, never forked) or "bottom" (no sleeves).
GarmentExtent garment_extent(const std::string& garment, const PointCloud& cloud, const MeshQuery& naked,
                             const BodyLimbs& limbs);

// Trousers and skirts whose upper end a top hides reach up to the body's waist, however long the top is: two legs alone
// would be no garment.
GarmentExtent up_to_the_waist(GarmentExtent bottom, const GarmentExtent& top, const BodyLimbs& limbs);

// The part of the body that a garment goes round: the naked body without the limbs that stick out of it, and for
// garments that are not forked a convex tube round both legs.
class CoveredBody {
 public:
  CoveredBody(const MeshQuery& naked, const BodyLimbs& limbs, const std::string& garment, const GarmentExtent& extent,
              double margin_m);

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
  const BodyLimbs& limbs_;
  GarmentExtent extent_;
  double margin_m_;
  std::vector<bool> kept_;  // of the naked triangles
  MeshQuery covered_, tube_;
  struct Fork {
    MeshQuery limb, other;
    Vector3d from, direction;  // only beyond the plane through `from`
  };
  std::vector<Fork> forks_;
  Vector3d low_ = Vector3d::Zero(), high_ = Vector3d::Zero();
};

}  // namespace dressform
