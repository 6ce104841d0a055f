#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "synthetic/garments/tube.h"

namespace dressform {

// Signed field of a solid: metres, negative inside, near the surface the distance to first order.
using Field = std::function<double(const Vector3d&)>;

// Polynomial smooth minimum: joins two solids with a fillet of about `blend` metres.
double smooth_union(double a, double b, double blend);
double smooth_intersection(double a, double b, double blend);

double ellipsoid_field(const Vector3d& point, const Vector3d& center, const Vector3d& radii);

// Capsule whose radius goes from `radius_a` to `radius_b`.
double capsule_field(const Vector3d& point, const Vector3d& a, const Vector3d& b, double radius_a, double radius_b);

// Parts joined one after the other, each with its own fillet. A part further than its fillet reaches is not evaluated.
class Solid {
 public:
  void add(const Tube& tube, double blend);
  void add_ellipsoid(const Vector3d& center, const Vector3d& radii, double blend);
  void add_capsule(const Vector3d& a, const Vector3d& b, double radius_a, double radius_b, double blend);
  // Takes the ellipsoid away again (eye sockets).
  void carve_ellipsoid(const Vector3d& center, const Vector3d& radii, double blend);
  void add_field(const Field& field, const Eigen::AlignedBox3d& box, double blend);
  void cut_below(double y);  // keeps what is above the height
  double field(const Vector3d& point) const;

 private:
  struct Part {
    Field field;
    Eigen::AlignedBox3d box;
    double blend;
    bool carve;
  };
  std::vector<Part> parts_;
  double floor_ = -1e3;
};

}  // namespace dressform
