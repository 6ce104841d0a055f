#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dressform {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Cross-section of a limb or of the torso: a closed curve about `center`, one half-ellipse of its own to each side,
// squarer as the exponent grows (2: ellipse). u and v are the two directions across the axis; metres.
struct LimbSection {
  double s = 0;                    // where along the axis
  Vector2d center{0, 0};           // (u, v)
  double u_plus = 0, u_minus = 0;  // half-breadths towards +u and -u
  double v_plus = 0, v_minus = 0;  // half-depths towards +v and -v
  double exponent = 2;

  double radius(double angle) const;  // from the center, angle from +u towards +v
  double perimeter() const;
  LimbSection scaled_to_perimeter(double perimeter_m) const;
};

// Smooth interpolation (Catmull-Rom in all members) between sections sorted by s.
LimbSection interpolate(const std::vector<LimbSection>& sections, double s);

// A solid about a straight axis whose surface is given in polar coordinates: radius(s, angle) about a center that may
// move with s. The field is the signed distance to first order, negative inside.
class Tube {
 public:
  // Orthonormal (of either hand); s = 0 at the origin. By default an upright tube with u to the body's left, v forward.
  struct Frame {
    Vector3d origin{0, 0, 0}, u{1, 0, 0}, v{0, 0, 1}, axis{0, 1, 0};
  };

  static Tube from_sections(const Frame& frame, const std::vector<LimbSection>& sections);

  // radii: row per station of `s_min + i * step`, `angles` columns from +u towards +v; centers: one per row.
  Tube(const Frame& frame, double s_min, double step, int angles, std::vector<double> radii,
       std::vector<Vector2d> centers);

  double field(const Vector3d& point) const;
  double radius(double s, double angle) const;
  Vector2d center(double s) const;
  const Frame& frame() const { return frame_; }
  double s_min() const { return s_min_; }
  double s_max() const { return s_min_ + step_ * (rows() - 1); }
  int rows() const { return static_cast<int>(centers_.size()); }
  int angles() const { return angles_; }
  double largest_radius() const { return largest_radius_; }

  // (s, angle, distance from the moving center) of a point.
  Vector3d polar(const Vector3d& point) const;
  Vector3d point(double s, double angle, double radius) const;

 private:
  Frame frame_;
  double s_min_, step_;
  int angles_;
  std::vector<double> radii_;
  std::vector<Vector2d> centers_;
  double largest_radius_ = 0;
};

}  // namespace dressform
