#include <algorithm>
#include <cmath>

#include "synthetic/body/figure.h"

namespace dressform {

void add_arm(const FigurePlan& plan, Solid& solid) {
  const BodySizes& p = plan.sizes;
  const double upper = plan.shape.upper_arm * p.upper_arm_girth, forearm = plan.shape.forearm * p.forearm_girth;
  const double wrist_girth = plan.shape.wrist * p.wrist_girth;
  const double elbow = plan.elbow_s, wrist = plan.wrist_s, lower = wrist - elbow, thin = upper / (2 * M_PI);
  const auto ring = [&](double s, double girth, double in, double out, double front, double back) {
    return limb_ring(s, {0, arm_forward(plan, s)}, girth, in, out, front, back);
  };
  const std::vector<LimbSection> sections{
      ring(-0.012, 0.58 * upper, 1, 1, 1, 1),
      ring(0.022, 0.90 * upper, 0.9, 1.0, 1.02, 1.0),
      ring(0.30 * elbow, 1.03 * upper, 0.94, 1.06, 1.03, 1.03),
      ring(0.54 * elbow, upper, 0.95, 0.95, 1.08, 1.04),
      ring(0.76 * elbow, 0.90 * upper, 0.96, 0.96, 1.06, 1.02),
      ring(0.95 * elbow, 0.50 * upper + 0.37 * forearm, 1.04, 1.00, 0.94, 1.00),
      ring(elbow + 0.05 * lower, 0.96 * forearm, 1.04, 1.02, 0.98, 0.98),
      ring(elbow + 0.20 * lower, forearm, 1.00, 1.02, 1.03, 0.97),
      ring(elbow + 0.48 * lower, 0.86 * forearm, 0.95, 0.95, 1.03, 1.01),
      ring(elbow + 0.76 * lower, 0.42 * forearm + 0.36 * wrist_girth, 0.90, 0.90, 1.06, 1.06),
      ring(wrist - 0.010, wrist_girth, 0.80, 0.80, 1.12, 1.12),
      ring(wrist + 0.010, 0.96 * wrist_girth, 0.76, 0.76, 1.15, 1.15),
      ring(wrist + 0.034, 0.66 * wrist_girth, 0.76, 0.76, 1.15, 1.15),
  };
  solid.add(Tube::from_sections(plan.arm, sections), 0.016);
  // The shoulder's muscle, and the bone at the elbow.
  solid.add_ellipsoid(plan.shoulder + 0.016 * plan.arm.axis - 0.004 * plan.arm.u,
                      {1.06 * thin, 1.10 * thin, 1.14 * thin}, 0.026);
  const double behind = arm_forward(plan, elbow) - 0.80 * 0.92 * forearm / (2 * M_PI);
  solid.add_ellipsoid(plan.shoulder + elbow * plan.arm.axis + behind * plan.arm.v, {0.017, 0.020, 0.014}, 0.018);
}

void add_hand(const FigurePlan& plan, Solid& solid) {
  const BodySizes& p = plan.sizes;
  const double size = p.hand_length / 0.193, palm = p.hand_breadth / 2;
  Tube::Frame frame;  // goes on along the forearm
  frame.origin = plan.wrist;
  frame.axis = (plan.wrist - plan.elbow).normalized();
  frame.u = plan.arm.u;
  frame.v = (plan.arm.v - plan.arm.v.dot(frame.axis) * frame.axis).normalized();
  const auto at = [&](double along, double out, double forward) -> Vector3d {
    return frame.origin + along * p.hand_length * frame.axis + out * size * frame.u + forward * palm * frame.v;
  };
  // at (part of the hand), half-thickness, half-breadth, curl towards the thigh
  const double rows[][4] = {{-0.06, 0.0160, 0.56, 0.000},
                            {0.10, 0.0165, 0.73, 0.000},
                            {0.26, 0.0150, 0.92, -0.001},
                            {0.42, 0.0135, 1.00, -0.003},
                            {0.50, 0.0115, 0.99, -0.004}};
  std::vector<LimbSection> sections;
  for (const auto& row : rows)
    sections.push_back(
        {row[0] * p.hand_length, {row[3] * size, 0}, row[1] * size, row[1] * size, row[2] * palm, row[2] * palm, 2.4});
  solid.add(Tube::from_sections(frame, sections), 0.016);
  // Fingers from the first one on: tip, forward at the root and at the tip, radius; they curl a little inwards.
  const double fingers[][4] = {{0.930, 0.73, 0.74, 0.226},
                               {0.990, 0.25, 0.26, 0.234},
                               {0.945, -0.24, -0.25, 0.228},
                               {0.835, -0.71, -0.72, 0.214}};
  for (const auto& finger : fingers) {
    const double radius = finger[3] * palm, root = 0.40, end = finger[0] - radius / p.hand_length,
                 middle = root + 0.55 * (end - root);
    const Vector3d joint = at(middle, -0.008, 0.5 * (finger[1] + finger[2]));
    solid.add_capsule(at(root, -0.002, finger[1]), joint, 1.05 * radius, radius, 0.32 * palm);
    solid.add_capsule(joint, at(end, -0.018, finger[2]), radius, 0.96 * radius, 0.32 * palm);
  }
  const Vector3d root = at(0.14, -0.006, 0.50), joint = at(0.36, -0.016, 1.18);
  solid.add_capsule(root, joint, 0.0165 * size, 0.0120 * size, 0.016);
  solid.add_capsule(joint, at(0.52, -0.022, 1.34), 0.0112 * size, 0.0094 * size, 0.006);
}

}  // namespace dressform
