#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/surface/covered_body.h"
#include "scenes/mesh.h"

namespace dressform {

// How far cloth round a leg can reach towards the other leg, where no view sees it: little beyond the convex hull of
// the leg and what is seen of the cloth, level by level. An ease that is harmonic round the leg would make it bulge
// there, by as much as it stands off the leg outside.
class LegHulls {
 public:
  // Without hulls where the garment is not forked.
  LegHulls(const PointCloud& cloth, const Mesh& body, const Landmarks& limbs, const GarmentLayout& layout,
           double margin_m);

  // Distance beyond the hull, negative within; far within where no hull is known and on the sides of the legs that
  // do not face each other.
  double beyond(const Vector3d& point) const;

 private:
  struct Edge {
    Eigen::Vector2d normal;  // outward
    double offset = 0;
  };
  using Hull = std::vector<Edge>;  // of one level; empty: not known
  struct Leg {
    std::vector<Hull> hulls;  // downwards from top_y_
    std::vector<Eigen::Vector2d> centres;
    Eigen::Vector2d inwards = Eigen::Vector2d::Zero();  // towards the other leg
  };

  Leg make_leg(int side, const PointCloud& cloth, const Mesh& body, const Landmarks& limbs, double bottom_y) const;
  double at_level(const Leg& leg, int level, const Eigen::Vector2d& at) const;

  bool known_ = false;
  double top_y_ = 0;
  Vector3d middle_ = Vector3d::Zero(), left_ = Vector3d::Zero();
  std::array<Leg, 2> legs_;
};

}  // namespace dressform
