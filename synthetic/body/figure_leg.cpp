#include <algorithm>
#include <cmath>

#include "synthetic/body/figure.h"

namespace dressform {
namespace {

// A ring with its half-breadth given: the depth makes up the girth.
LimbSection flat_ring(double s, const Vector2d& center, double girth, double half_breadth, double front, double back,
                      double exponent) {
  double depth = half_breadth;
  for (int i = 0; i < 20; ++i) {
    const LimbSection section{s, center, half_breadth, half_breadth, front * depth, back * depth, exponent};
    depth = std::max(0.4 * half_breadth, depth + 0.25 * (girth - section.perimeter()));
  }
  return {s, center, half_breadth, half_breadth, front * depth, back * depth, exponent};
}

}  // namespace

void add_leg(const FigurePlan& plan, Solid& solid) {
  const BodySizes& p = plan.sizes;
  const BodyLandmarks& m = plan.marks;
  const double thigh = m.crotch - m.knee, shin = m.knee - m.ankle;
  const double knee_x = 0.45 * plan.leg_x + 0.55 * plan.ankle_x;
  const auto at = [&](double y, double forward) {  // the leg's axis: from the hip over the knee to the ankle
    const bool above = y > m.knee;
    const double t = above ? (y - m.knee) / thigh : (m.knee - y) / shin;
    const double x = knee_x + t * ((above ? plan.leg_x : plan.ankle_x) - knee_x);
    const double z = plan.knee_z + t * ((above ? 0.0 : plan.ankle_z) - plan.knee_z);
    return Vector2d(x, z + forward);
  };
  const double girth_thigh = plan.shape.thigh * p.thigh_girth, girth_low = plan.shape.lower_thigh * p.lower_thigh_girth;
  const double girth_calf = plan.shape.calf * p.calf_girth, girth_ankle = plan.shape.ankle * p.ankle_girth;
  const auto ring = [&](double y, double forward, double girth, double in, double out, double front, double back) {
    return limb_ring(y, at(y, forward), girth, in, out, front, back);
  };
  const auto shin_at = [&](double t) { return m.ankle + t * shin; };
  const auto thigh_at = [&](double t) { return m.knee + t * thigh; };
  std::vector<LimbSection> sections{
      ring(m.ankle - 0.045, 0.004, 1.06 * girth_ankle, 1, 1, 1.1, 1.1),
      ring(m.ankle + 0.002, 0.002, 1.10 * girth_ankle, 1, 1, 1.05, 1.22),
      ring(m.ankle + 0.028 * m.stature, 0.003, 1.00 * girth_ankle, 0.92, 0.92, 1.0, 1.16),
      ring(shin_at(0.34), 0.000, 0.5 * (1.02 * girth_ankle + 0.72 * girth_calf), 0.95, 0.95, 0.96, 1.10),
      ring(shin_at(0.52), -0.004, 0.90 * girth_calf, 1.02, 0.98, 0.86, 1.14),
      ring(shin_at(0.68), -0.005, girth_calf, 1.04, 1.00, 0.82, 1.16),
      ring(shin_at(0.84), -0.002, 0.945 * girth_calf, 0.99, 1.00, 0.90, 1.08),
      ring(m.knee - 0.016, 0.004, 0.905 * girth_low, 0.98, 0.98, 1.02, 1.0),
      ring(m.knee + 0.006, 0.004, 0.925 * girth_low, 1.0, 0.98, 1.02, 0.98),
      ring(m.knee + 0.034 * m.stature, 0.004, girth_low, 1.0, 0.96, 1.04, 1.0),
      ring(thigh_at(0.40), 0.012, 0.62 * girth_low + 0.36 * girth_thigh, 0.96, 0.98, 1.08, 0.98),
      ring(thigh_at(0.68), 0.012, 0.28 * girth_low + 0.70 * girth_thigh, 0.94, 1.0, 1.08, 1.02),
      flat_ring(thigh_at(0.955), {plan.leg_x, 0.004}, girth_thigh, plan.thigh_half, 1.0, 1.02, 2.25),
  };
  // At the hips the thigh fills the trunk's outline, so that the trunk rules the girth.
  const double front = 0.44 * plan.hip_depth, back = 0.42 * plan.hip_depth;
  const double exponent = 0.5 * (2.15 + plan.shape.hip.exponent());
  sections.push_back({m.hip, {plan.leg_x, 0.002}, plan.thigh_half, 0.84 * plan.leg_x, front, back, exponent});
  sections.push_back({m.hip + 0.030 * m.stature,
                      {0.95 * plan.leg_x, 0},
                      0.95 * plan.thigh_half,
                      0.80 * plan.leg_x,
                      0.94 * front,
                      0.94 * back,
                      exponent});
  sections.push_back({m.hip + 0.075 * m.stature,
                      {0.82 * plan.leg_x, 0},
                      0.72 * plan.thigh_half,
                      0.65 * plan.leg_x,
                      0.65 * front,
                      0.65 * back,
                      2.1});
  solid.add(Tube::from_sections({}, sections), 0.022);
  // Kneecap.
  const Vector2d knee = at(m.knee, 0);
  const double round = girth_low / (2 * M_PI);
  solid.add_ellipsoid({knee.x(), m.knee, knee.y() + 0.70 * round}, {0.42 * round, 0.018 * m.stature, 0.31 * round},
                      0.026);
}

void add_foot(const FigurePlan& plan, Solid& solid) {
  const BodySizes& p = plan.sizes;
  const double turn = 9 * M_PI / 180, length = p.foot_length, ball = p.foot_breadth / 2, top = plan.marks.ankle;
  Tube::Frame frame;
  frame.axis = Vector3d(std::sin(turn), 0, std::cos(turn));
  frame.u = Vector3d(std::cos(turn), 0, -std::sin(turn));
  frame.v = Vector3d::UnitY();
  frame.origin = Vector3d(plan.ankle_x, 0, plan.ankle_z) - 0.225 * length * frame.axis;
  // at, half-breadth, height, to the outside; the sole reaches below the floor and is cut off flat.
  const double rows[][4] = {{0.000, 0.26, 0.42, 0},   {0.025, 0.46, 0.68, 0},    {0.09, 0.60, 0.98, 0},
                            {0.22, 0.64, 1.25, 0},    {0.36, 0.66, 1.12, 0.02},  {0.50, 0.76, 0.84, 0.04},
                            {0.64, 0.93, 0.58, 0.02}, {0.74, 0.97, 0.43, -0.01}, {0.82, 0.90, 0.33, -0.03},
                            {0.87, 0.78, 0.26, -0.05}};
  std::vector<LimbSection> sections;
  for (const auto& row : rows) {
    const double height = row[2] * top, middle = std::min(0.015, 0.5 * height);
    sections.push_back(
        {row[0] * length, {row[3] * ball, middle}, row[1] * ball, row[1] * ball, height - middle, middle + 0.02, 2.3});
  }
  solid.add(Tube::from_sections(frame, sections), 0.020);
  // Toes: root and tip along the foot, to the outside, radius.
  const double toes[][4] = {{0.80, 0.982, -0.58, 0.0135},
                            {0.80, 1.000, -0.18, 0.0100},
                            {0.79, 0.972, 0.13, 0.0093},
                            {0.77, 0.930, 0.42, 0.0088},
                            {0.75, 0.880, 0.68, 0.0085}};
  for (const auto& toe : toes) {
    const double radius = toe[3] * length / 0.271;
    const auto place = [&](double s, double height) -> Vector3d {
      return frame.origin + s * frame.axis + toe[2] * ball * frame.u + height * frame.v;
    };
    solid.add_capsule(place(toe[0] * length, 1.05 * radius), place(toe[1] * length - radius, 0.80 * radius),
                      1.1 * radius, radius, 0.008);
  }
  // Ankle bones, the outer one lower.
  const double out = 0.53 * p.ankle_girth / M_PI;
  solid.add_ellipsoid({plan.ankle_x + 0.84 * out, top, plan.ankle_z}, {0.009, 0.015, 0.013}, 0.014);
  solid.add_ellipsoid({plan.ankle_x - 0.84 * out, top + 0.012, plan.ankle_z + 0.006}, {0.009, 0.015, 0.013}, 0.014);
}

}  // namespace dressform
