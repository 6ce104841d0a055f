#pragma once
#include <Eigen/Geometry>
#include <map>
#include <string>

#include "synthetic/body/anthropometry.h"
#include "synthetic/body/body.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// Factors on the torso's breadth and depth at the three measured heights; what the girths are solved with.
struct GirthFactors {
  double chest = 1, waist = 1, hip = 1;
};

// The shop mannequin as a field: left half, mirrored at x = 0. World frame, stands on y = 0, faces +z.
struct Mannequin {
  Solid left_half;
  Eigen::AlignedBox3d box;
  BodyLandmarks landmarks;
  std::map<std::string, Vector3d> joints;

  double field(const Vector3d& p) const { return left_half.field(Vector3d(std::abs(p.x()), p.y(), p.z())); }
};

// Landmark heights and joints follow from the proportions alone, not from the factors.
Mannequin make_mannequin(const BodySpec& spec, const Proportions& proportions, const GirthFactors& factors);

}  // namespace dressform
