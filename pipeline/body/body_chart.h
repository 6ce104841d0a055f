#pragma once
#include "pipeline/body/body_landmarks.h"

namespace dressform {

// A place on a standing body by limb.
struct ChartPlace {
  BodyPart limb = BodyPart::torso;
  double along_m = 0;   // arms and legs: from the root towards the end, along the axis; torso and head: over the crotch
  double angle = 0;     // about the axis, -pi to pi: 0 = front, a quarter turn = the body's left
  double radius_m = 0;  // from the axis
};

// Coordinates on a standing body: which limb, how far along it, and which way round. Model frame, metres, radians.
// (Cylindrical coordinates of limbs as in Allen, Curless and Popovic, "Articulated body deformation from range scan
// data", SIGGRAPH 2002.)
class BodyChart {
 public:
  explicit BodyChart(const Landmarks& landmarks) : landmarks_(landmarks) {}

  // In the coordinates of that limb, which the body has to have.
  ChartPlace place(const Vector3d& point, BodyPart limb) const;

  // How far down its limb a point is, 0 root, 1 fingers or toes; 0 on torso and head, and on limbs that are not known.
  double part_of_limb(const Vector3d& point, BodyPart limb) const;

 private:
  const Limb* limb_of(BodyPart part) const;
  const Landmarks& landmarks_;
};

}  // namespace dressform
