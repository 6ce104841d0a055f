#pragma once
#include "synthetic/body/body.h"
#include "synthetic/garments/garment_shape.h"

namespace dressform {

// A hood worn up: cloth about neck and head, open before the face. Two panels, joined along the middle of the head.
class Hood {
 public:
  // neck_depth_m: how far below the neck's side the opening reaches in front. Throws InputError for a body without a
  // head.
  Hood(const Body& body, double neck_depth_m);

  double field(const Vector3d& point) const;    // metres, negative inside
  double opening(const Vector3d& point) const;  // positive before the face
  double top() const { return center_.y() + radii_.y(); }

  // side: +1 the left panel, -1 the right one.
  ClothPiece panel(double side) const;

 private:
  Vector3d center_, radii_;   // of an ellipsoid about the head
  Vector3d neck_;             // middle of the neck's base
  double neck_radius_ = 0;    // of the hood there
  double bottom_y_ = 0;       // of the opening
  double throat_half_ = 0;    // half its width there
  double brow_z_, throat_z_;  // of the opening's edge, at the head's middle and at the bottom
};

// Appends the hood's two panels to a shirt's pieces; it is sewn on along `seam` (positive on the hood).
void add_hood_panels(const Hood& hood, const Level& seam, GarmentShape& shape);

}  // namespace dressform
