#pragma once
#include <Eigen/Geometry>
#include <map>
#include <string>

#include "synthetic/body/anthropometry.h"
#include "synthetic/body/body.h"
#include "synthetic/body/figure.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// A standing figure as a field: two halves, the right one mirrored at x = 0; they differ in their arms alone. World
// frame, stands on y = 0, faces +z.
struct Mannequin {
  Solid left_half, right_half;
  Eigen::AlignedBox3d box;
  BodyLandmarks landmarks;
  std::map<std::string, Vector3d> joints;

  double field(const Vector3d& p) const {
    return (p.x() < 0 ? right_half : left_half).field(Vector3d(std::abs(p.x()), p.y(), p.z()));
  }
};

// Landmark heights and joints follow from the sizes alone, not from the shape.
Mannequin make_mannequin(const BodySpec& spec, const BodySizes& sizes, const FigureShape& shape);

// Height of the crotch: the lowest place of the trunk in the middle, above knee height.
double crotch_height(const Mannequin& mannequin);
// Height of the crown.
double top_height(const Mannequin& mannequin);

}  // namespace dressform
