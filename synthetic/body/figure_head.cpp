#include <cmath>

#include "synthetic/body/figure.h"

namespace dressform {
namespace {

void add_neck(const FigurePlan& plan, Solid& solid) {
  const BodySizes& p = plan.sizes;
  const double girth = plan.shape.neck * p.neck_girth, h = p.stature;
  Tube::Frame frame;
  frame.origin = plan.neck_center;
  frame.axis = plan.neck_axis;
  frame.u = Vector3d::UnitX();
  frame.v = Vector3d::UnitX().cross(plan.neck_axis);
  if (frame.v.z() < 0) frame.v = -frame.v;
  std::vector<LimbSection> rings{
      limb_ring(-0.050 * h, {0, 0.000}, 1.14 * girth, 1, 1, 0.92, 0.80),
      limb_ring(-0.022 * h, {0, 0.000}, 1.08 * girth, 1, 1, 0.98, 0.98),
      limb_ring(0, {0, 0.000}, girth, 1, 1, 1.02, 1.02),
      limb_ring(0.025 * h, {0, -0.002}, 0.975 * girth, 0.98, 0.98, 1.02, 1.02),
      limb_ring(0.060 * h, {0, -0.006}, 0.96 * girth, 0.98, 0.98, 1, 1),
  };
  solid.add(Tube::from_sections(frame, rings), 0.034);
}

}  // namespace

void add_neck_and_head(const FigurePlan& plan, Solid& solid) {
  const BodySizes& p = plan.sizes;
  add_neck(plan, solid);
  const double unit = p.head_top_above_ear / 0.131;  // 1 for the average man
  const double half = plan.shape.head_breadth * p.head_breadth / 2, length = plan.shape.head_length * p.head_length;
  const double top = p.stature + plan.shape.crown_m, z = plan.head_z;
  const auto at = [&](double x, double below_top, double forward) {
    return Vector3d(x, top - below_top * unit, z + forward * unit);
  };
  const auto size = [&](double x, double y, double w) -> Vector3d { return Vector3d(x, y, w) * unit; };
  const double jaw = plan.female ? 0.92 : 1.0;
  // Skull, face, jaw and chin; then cheek bones, brow, nose, eye sockets, eyes, lips, ears.
  Solid head;
  head.add_ellipsoid({0, top - 0.092 * unit, z - 0.16 * length}, {half, 0.090 * unit, 0.35 * length}, 0);
  head.add_ellipsoid({0, top - 0.096 * unit, z + 0.12 * length}, {0.95 * half, 0.094 * unit, 0.37 * length}, 0.030);
  head.add_ellipsoid({0, top - 0.090 * unit, z - 0.02 * length}, {0.90 * half, 0.090 * unit, 0.40 * length}, 0.030);
  head.add_ellipsoid(at(0, 0.145, 0.034), size(0.060 * jaw, 0.082, 0.056), 0.034);
  head.add_ellipsoid(at(0, 0.186, 0.040), size(0.046 * jaw, 0.038, 0.046), 0.030);
  head.add_ellipsoid(at(0, 0.212, 0.074), size(0.018 * jaw, 0.015, 0.014), 0.022);
  const Vector3d jut = plan.chin * Vector3d(0, -0.6, 0.8);  // a jaw grows the way it points
  if (plan.chin > 0) {
    head.add_capsule(at(0, 0.190, 0.045), at(0, 0.208, 0.070) + jut, 0.034 * unit, 0.017 * unit, 0.022);
    head.add_ellipsoid(at(0, 0.212, 0.074) + jut, size(0.018 * jaw, 0.015, 0.014), 0.014);
  }
  head.add_ellipsoid(at(0.040, 0.144, 0.056), size(0.018, 0.014, 0.018), 0.022);
  head.add_ellipsoid(at(0.026, 0.103, 0.077), size(0.026, 0.008, 0.011), plan.female ? 0.016 : 0.012);
  head.carve_ellipsoid(at(0.032, 0.119, 0.096), size(0.019, 0.012, 0.014), 0.010);
  head.add_ellipsoid(at(0.031, 0.119, 0.075), size(0.014, 0.010, 0.012), 0.004);
  head.add_capsule(at(0, 0.112, 0.085), at(0, 0.152, 0.102), 0.0075 * unit, 0.0105 * unit, 0.012);
  head.add_ellipsoid(at(0.009, 0.157, 0.093), size(0.009, 0.007, 0.009), 0.007);
  head.add_ellipsoid(at(0, 0.178, 0.083), size(0.022, 0.006, 0.010), 0.007);
  head.add_ellipsoid(at(0, 0.188, 0.081), size(0.019, 0.006, 0.010), 0.006);
  head.add_ellipsoid({half - 0.003, top - 0.127 * unit, z - 0.010}, size(0.008, 0.027, 0.016), 0.012);
  Eigen::AlignedBox3d box(Vector3d(-half - 0.02, top - 0.235 * unit + jut.y(), z - length / 2 - 0.02),
                          Vector3d(half + 0.02, top, z + length / 2 + 0.035 + jut.z()));
  // Bowed about the top of the neck.
  const Vector3d pivot = plan.neck_center + 0.050 * p.stature * plan.neck_axis;
  const Isometry3d bowed =
      Eigen::Translation3d(pivot) * Eigen::AngleAxisd(plan.bow, Vector3d::UnitX()) * Eigen::Translation3d(-pivot);
  const Isometry3d upright = bowed.inverse();
  if (plan.bow > 0) box = box.transformed(bowed);
  solid.add_field([head, upright](const Vector3d& q) { return head.field(upright * q); }, box, 0.022);
}

}  // namespace dressform
