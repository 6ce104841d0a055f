#include "synthetic/garments/hood.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "synthetic/body/section.h"

namespace dressform {
namespace {

constexpr double kEase = 0.014;    // between head and hood, m
constexpr double kThroat = 0.6;    // slope at which the opening's edge goes back below the neck
constexpr double kCorner = 0.035;  // of the opening's lower corners, m

// What of the body is head: above the jaw's angle.
std::vector<Vector3d> head_points(const Body& body) {
  const double from = body.landmarks.neck + 0.40 * (body.landmarks.stature - body.landmarks.neck);
  std::vector<Vector3d> points;
  for (const Vector3d& v : body.mesh.vertices)
    if (v.y() > from && std::abs(v.x()) < 0.2) points.push_back(v);
  return points;
}

// Breadth of the neck's base, and where it stands.
Eigen::AlignedBox2d neck_section(const Body& body, double y) {
  Eigen::AlignedBox2d box;
  for (const Polygon& polygon : torso_part(horizontal_section(body.mesh, y)))
    for (const Vector2d& p : polygon.points) box.extend(p);
  return box;
}

}  // namespace

Hood::Hood(const Body& body, double neck_depth_m) {
  const BodyLandmarks& m = body.landmarks;
  const double above = m.stature - m.neck, size = m.stature / 1.75;
  const auto points = head_points(body);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  if (points.empty() || above < 0.10 * m.stature)
    throw InputError(
        "garment.collar",
        fmt::format("found \"hood\" on a body whose neck is {:.2f} m below its top; expected a head", above));
  center_ = box.center();
  center_.z() -= 0.03 * box.sizes().z();  // fuller at the back
  radii_ = 0.5 * box.sizes();
  brow_z_ = center_.z() + 0.95 * radii_.z();
  double scale = 1;
  for (const Vector3d& p : points)
    if (p.z() < center_.z() + 0.6 * radii_.z()) scale = std::max(scale, (p - center_).cwiseQuotient(radii_).norm());
  radii_ = scale * radii_ + Vector3d::Constant(kEase);
  const Eigen::AlignedBox2d neck = neck_section(body, m.neck + 0.02);
  neck_ = {0, m.neck - 0.01 * size, neck.center().y() - 0.02 * size};
  neck_radius_ = 0.5 * neck.sizes().maxCoeff() + 0.022 * size;
  throat_half_ = 0.085 * size;
  throat_z_ = neck.center().y() + 0.40 * neck.sizes().y();
  bottom_y_ = m.neck + 0.020 - neck_depth_m * size;
}

double Hood::field(const Vector3d& p) const {
  const Vector3d below = center_ - Vector3d(0, 0.35 * radii_.y(), 0.1 * radii_.z());
  const double column = capsule_field(p, neck_, below, neck_radius_, 0.85 * radii_.x());
  return smooth_union(ellipsoid_field(p, center_, radii_), column, 0.05);
}

double Hood::opening(const Vector3d& p) const {
  const double above = p.y() - neck_.y(), up = std::min(above / (center_.y() - neck_.y()), 1.3);
  const double edge = above > 0 ? throat_z_ + up * (brow_z_ - throat_z_) : throat_z_ + kThroat * above;
  const double above_neck = std::clamp(above / 0.12, 0.0, 1.0);
  const double half_width = throat_half_ + above_neck * (radii_.x() + 0.05 - throat_half_);
  return smooth_union(std::min(p.z() - edge, half_width - std::abs(p.x())), p.y() - bottom_y_, kCorner);
}

ClothPiece Hood::panel(double side) const {
  // Above the head's middle the directions from the ear and the distances over the cloth stay as they are; below, the
  // cloth is rolled off about the neck.
  const Vector3d center = center_, radii = radii_;
  const double radius = radii.mean();
  ClothPiece piece;
  piece.place = [=](const Vector3d& p, const Vector3d&) -> Vector2d {
    const Vector3d d = (p - center).cwiseQuotient(radii);
    const Vector2d away(-side * d.z(), d.y() > 0 ? -d.y() : 0.0);  // to the right and down
    const double angle = std::atan2(away.norm(), side * d.x());
    const Vector2d on_panel = radius * angle * (away.norm() > 1e-9 ? Vector2d(away.normalized()) : Vector2d(0, 0));
    return on_panel + Vector2d(0, std::max(0.0, center.y() - p.y()));
  };
  return piece;
}

void add_hood_panels(const Hood& hood, const Level& seam, GarmentShape& shape) {
  const int first = static_cast<int>(shape.pieces.size());
  for (const double side : {1.0, -1.0}) shape.pieces.push_back(hood.panel(side));
  shape.seams.push_back(seam);
  shape.seams.push_back([seam](const Vector3d& p) { return std::min(seam(p), p.x()); });
  shape.piece_of = [seam, first, shirt = shape.piece_of](const Vector3d& p) {
    return seam(p) < 0 ? shirt(p) : p.x() > 0 ? first : first + 1;
  };
}

}  // namespace dressform
