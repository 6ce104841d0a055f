#include "synthetic/body/mannequin.h"

#include <cmath>

namespace dressform {
namespace {

constexpr double kTwoPi = 6.283185307179586;

// Sizes that several parts share.
struct Plan {
  const BodySpec& spec;
  const Proportions& p;
  GirthFactors factors;
  BodyLandmarks marks;
  bool female;
  double hip_front, hip_back, waist_front, waist_back, chest_front, chest_back;  // depths from the axis x = z = 0
  double chest_half, waist_half, hip_half;                                       // half-breadths
  double thigh_half, leg_x, ankle_x, ankle_z;
  Vector3d shoulder, elbow, wrist, hand_tip;  // left
};

BodyLandmarks landmarks_of(const BodySpec& spec, const Proportions& p) {
  BodyLandmarks marks;
  marks.stature = spec.stature_m;
  marks.neck = p.cervicale_height;
  marks.shoulder = p.acromion_height;
  marks.armpit = p.axilla_height;
  marks.chest = p.chest_height - 0.008 * spec.stature_m;  // clear of the armpit
  marks.waist = p.waist_height + 0.018 * spec.stature_m;  // the narrowest place, above the navel
  marks.hip = p.hip_height;
  marks.crotch = p.crotch_height;
  marks.knee = p.knee_height;
  marks.ankle = p.ankle_height;
  return marks;
}

Plan make_plan(const BodySpec& spec, const Proportions& p, const GirthFactors& factors) {
  Plan plan{spec, p,  factors, landmarks_of(spec, p), spec.sex == "female", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, {},
            {},   {}, {}};
  const auto split = [](double depth, double front_part, double factor, double& front, double& back) {
    front = factor * depth * front_part;
    back = factor * depth * (1 - front_part);
  };
  split(p.hip_depth, 0.45, factors.hip, plan.hip_front, plan.hip_back);
  split(p.waist_depth, 0.54, factors.waist, plan.waist_front, plan.waist_back);
  split(plan.female ? 0.86 * p.chest_depth : p.chest_depth, 0.50, factors.chest, plan.chest_front, plan.chest_back);
  plan.hip_half = factors.hip * p.hip_breadth / 2;
  plan.waist_half = factors.waist * 0.97 * p.waist_breadth / 2;
  plan.chest_half = factors.chest * 1.13 * p.chest_breadth / 2;

  // The thighs fill the hips' outline but for a gap of 14 mm between them.
  plan.thigh_half = 0.5 * (0.985 * plan.hip_half - 0.007);
  plan.leg_x = 0.007 + plan.thigh_half;
  plan.ankle_x = std::max(plan.leg_x + 0.005, 0.058 * spec.stature_m);
  plan.ankle_z = -0.02 * spec.stature_m;

  const double angle = spec.arm_angle_deg * kTwoPi / 360;
  const double arm_radius = 0.9 * p.biceps_girth / kTwoPi;
  const Vector3d down(std::sin(angle), -std::cos(angle), 0);
  // Out of the chest's way: at chest height the arm's inner side stays 22 mm off the torso.
  const double drop = p.acromion_height - 0.042 - plan.marks.chest;
  const double clear = plan.chest_half + 0.022 + (arm_radius + 0.004) / std::cos(angle) - drop * std::tan(angle);
  const double natural = p.bideltoid_breadth / 2 - arm_radius - 0.010;
  plan.shoulder = Vector3d(std::max(natural, clear), p.acromion_height - 0.042, -0.018);
  plan.elbow = plan.shoulder + (p.upper_arm_length - 0.035) * down;
  plan.wrist = plan.elbow + p.forearm_length * down + Vector3d(0, 0, 0.035);
  plan.hand_tip = plan.wrist + p.hand_length * down + Vector3d(0, 0, 0.022);
  return plan;
}

LimbSection torso_section(double y, double half, double front, double back, double exponent) {
  return {y, {0, 0}, half, half, front, back, exponent};
}

void add_torso(const Plan& plan, Solid& solid) {
  const Proportions& p = plan.p;
  const BodyLandmarks& m = plan.marks;
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const double neck_half = p.neck_girth / kTwoPi;
  const double shoulder_half = std::max(p.biacromial_breadth / 2, plan.shoulder.x() + 0.012);
  const double yoke = m.neck - m.shoulder;  // from the acromion up to the neck bone
  const double waist_chest = m.chest - m.waist, hip_waist = m.waist - m.hip;
  solid.add(
      Tube::from_sections(
          {},
          {
              torso_section(m.crotch + 0.004, 0.35 * plan.hip_half, 0.30 * plan.hip_front, 0.35 * plan.hip_back, 2),
              torso_section(m.crotch + 0.016, 0.62 * plan.hip_half, 0.55 * plan.hip_front, 0.60 * plan.hip_back, 2),
              torso_section(m.hip, 0.965 * plan.hip_half, 0.93 * plan.hip_front, 0.80 * plan.hip_back, 2.15),
              torso_section(m.hip + 0.45 * hip_waist, mix(plan.hip_half, plan.waist_half, 0.34),
                            mix(plan.hip_front, plan.waist_front, 0.55) * 1.04,
                            mix(plan.hip_back, plan.waist_back, 0.62), 2.2),
              torso_section(m.waist, plan.waist_half, plan.waist_front, plan.waist_back, 2.25),
              torso_section(m.waist + 0.5 * waist_chest, mix(plan.waist_half, plan.chest_half, 0.56),
                            mix(plan.waist_front, plan.chest_front, 0.45) * 1.02,
                            mix(plan.waist_back, plan.chest_back, 0.62), 2.4),
              torso_section(m.chest, plan.chest_half, plan.chest_front * 0.95, plan.chest_back * 0.99, 2.6),
              torso_section(m.armpit, 1.04 * plan.chest_half, plan.chest_front * 0.88, plan.chest_back * 1.02, 2.5),
              torso_section(m.shoulder - 0.045, 0.97 * shoulder_half, 0.64 * plan.chest_front, 0.95 * plan.chest_back,
                            2.2),
              torso_section(m.shoulder - 0.010, 0.88 * shoulder_half, 0.46 * plan.chest_front, 0.86 * plan.chest_back,
                            2.1),
              torso_section(m.shoulder + 0.28 * yoke, mix(0.66 * shoulder_half, neck_half, 0.16),
                            0.34 * plan.chest_front, 0.78 * plan.chest_back, 2),
              torso_section(m.shoulder + 0.62 * yoke, neck_half * 1.25, 0.25 * plan.chest_front, 0.66 * plan.chest_back,
                            2),
              torso_section(m.neck, neck_half * 0.85, 0.2 * plan.chest_front, 0.55 * plan.chest_back, 2),
          }),
      0);
  if (plan.female) {
    const double bust = 0.24 * p.chest_depth * plan.factors.chest;
    solid.add_ellipsoid({0.50 * plan.chest_half, m.chest - 0.004, plan.chest_front + 0.20 * bust},
                        {0.90 * bust, 0.98 * bust, 0.92 * bust}, 0.035);
  } else {
    solid.add_ellipsoid({0.50 * plan.chest_half, m.chest + 0.018, 0.74 * plan.chest_front},
                        {0.50 * plan.chest_half, 0.062, 0.265 * plan.chest_front}, 0.040);
  }
  solid.add_ellipsoid({0.50 * plan.chest_half, m.armpit - 0.005, -0.66 * plan.chest_back},
                      {0.45 * plan.chest_half, 0.085, 0.42 * plan.chest_back}, 0.035);
  solid.add_ellipsoid({0.47 * plan.hip_half, m.hip - 0.002, -0.50 * plan.hip_back},
                      {0.50 * plan.hip_half, 0.095, 0.50 * plan.hip_back}, 0.028);
}

// Sections are given by girth and shape; the shape's absolute size does not matter.
LimbSection limb(double s, Vector2d center, double girth, double in, double out, double front, double back,
                 double exponent = 2.1) {
  return LimbSection{s, center, out, in, front, back, exponent}.scaled_to_perimeter(girth);
}

// The same with the half-breadth given: the depth makes up the girth.
LimbSection flat_limb(double s, Vector2d center, double girth, double half_breadth, double front, double back) {
  double depth = half_breadth;
  for (int i = 0; i < 20; ++i) {
    const LimbSection section{s, center, half_breadth, half_breadth, front * depth, back * depth, 2.2};
    depth = std::max(0.4 * half_breadth, depth + 0.25 * (girth - section.perimeter()));
  }
  return {s, center, half_breadth, half_breadth, front * depth, back * depth, 2.2};
}

void add_leg(const Plan& plan, Solid& solid) {
  const Proportions& p = plan.p;
  const BodyLandmarks& m = plan.marks;
  const double thigh = m.crotch - m.knee, shin = m.knee - m.ankle;
  const auto x = [&](double y) {  // the leg's axis runs straight from the hip joint to the ankle
    return plan.leg_x + (m.crotch - y) / (m.crotch - m.ankle) * (plan.ankle_x - plan.leg_x);
  };
  const double knee_girth = 0.965 * p.lower_thigh_girth;
  std::vector<LimbSection> sections{
      limb(m.ankle - 0.045, {plan.ankle_x, plan.ankle_z}, 1.00 * p.ankle_girth, 1, 1, 1.1, 1.1),
      limb(m.ankle + 0.010, {plan.ankle_x, plan.ankle_z}, 1.08 * p.ankle_girth, 1, 1, 1.05, 1.15),
      limb(m.ankle + 0.075, {x(m.ankle + 0.075), plan.ankle_z + 0.004}, 0.99 * p.ankle_girth, 0.95, 0.95, 1.0, 1.12),
      limb(m.ankle + 0.42 * shin, {x(m.ankle + 0.42 * shin), -0.020}, 0.84 * p.calf_girth, 0.98, 0.98, 0.92, 1.08),
      limb(m.ankle + 0.66 * shin, {x(m.ankle + 0.66 * shin), -0.012}, p.calf_girth, 1.02, 0.98, 0.84, 1.14),
      limb(m.ankle + 0.84 * shin, {x(m.ankle + 0.84 * shin), -0.004}, 0.93 * p.calf_girth, 1, 0.98, 0.95, 1.05),
      limb(m.knee, {x(m.knee), 0.004}, knee_girth, 0.98, 0.98, 1.06, 0.94),
      limb(m.knee + 0.20 * thigh, {x(m.knee + 0.20 * thigh), 0.005}, 1.02 * p.lower_thigh_girth, 0.97, 0.97, 1.04, 1.0),
      limb(m.knee + 0.55 * thigh, {x(m.knee + 0.55 * thigh), 0.006}, 0.855 * p.thigh_girth, 0.95, 0.98, 1.06, 1.02),
      flat_limb(m.knee + 0.95 * thigh, {plan.leg_x, 0.0}, p.thigh_girth, plan.thigh_half, 0.98, 1.02),
  };
  // At the hips the thigh fills the torso's outline, so that one factor rules the girth.
  sections.push_back(
      {m.hip, {plan.leg_x, 0}, plan.thigh_half, 0.95 * plan.leg_x, 0.86 * plan.hip_front, 0.80 * plan.hip_back, 2.1});
  sections.push_back({m.hip + 0.09,
                      {0.9 * plan.leg_x, 0},
                      0.85 * plan.thigh_half,
                      0.85 * plan.leg_x,
                      0.6 * plan.hip_front,
                      0.6 * plan.hip_back,
                      2.1});
  solid.add(Tube::from_sections({}, sections), 0.030);
}

void add_foot(const Plan& plan, Solid& solid) {
  const Proportions& p = plan.p;
  const double turn = 8 * kTwoPi / 360, length = p.foot_length, ball = p.foot_breadth / 2;
  Tube::Frame frame;
  frame.axis = Vector3d(std::sin(turn), 0, std::cos(turn));
  frame.u = Vector3d(std::cos(turn), 0, -std::sin(turn));
  frame.v = Vector3d::UnitY();
  frame.origin = Vector3d(plan.ankle_x, 0, plan.ankle_z) - 0.215 * length * frame.axis;
  // at, half-breadth, top; the sole reaches below the floor and is cut off flat.
  const double rows[][4] = {{0.00, 0.30, 0.50, 0},    {0.03, 0.50, 0.74, 0},     {0.10, 0.64, 1.00, 0},
                            {0.24, 0.68, 1.18, 0},    {0.40, 0.72, 0.98, 0.02},  {0.56, 0.88, 0.72, 0.03},
                            {0.72, 1.00, 0.50, 0},    {0.86, 0.90, 0.36, -0.04}, {0.95, 0.66, 0.29, -0.08},
                            {1.00, 0.34, 0.20, -0.10}};
  std::vector<LimbSection> sections;
  for (const auto& row : rows) {
    const double top = row[2] * plan.marks.ankle, middle = std::min(0.015, 0.5 * top);
    sections.push_back(
        {row[0] * length, {row[3] * ball, middle}, row[1] * ball, row[1] * ball, top - middle, middle + 0.02, 2.3});
  }
  solid.add(Tube::from_sections(frame, sections), 0.018);
}

void add_neck_and_head(const Plan& plan, Solid& solid) {
  const Proportions& p = plan.p;
  const BodyLandmarks& m = plan.marks;
  const double unit = p.head_top_above_ear / 0.131;  // 1 for the average man
  const double half = p.head_breadth / 2, length = p.head_length, top = m.stature;
  const double z = 0.012;  // the head sits a little forward
  const auto at = [&](double x, double below_top, double forward) {
    return Vector3d(x, top - 1.07 * below_top * unit, z + forward * unit);
  };
  const double chin_y = top - 0.219 * unit;
  std::vector<LimbSection> neck;
  const double slender = plan.female ? 0.97 : 1.0;
  const double low = m.neck - 0.085, high = chin_y + 0.045;
  neck.push_back(limb(low, {0, -0.035}, 1.16 * p.neck_girth, 1, 1, 0.9, 0.9));
  neck.push_back(limb(m.neck - 0.02, {0, -0.026}, 1.03 * p.neck_girth, 1, 1, 0.98, 0.98));
  neck.push_back(limb(m.neck + 0.03, {0, -0.016}, 0.97 * slender * p.neck_girth, 1, 1, 1.02, 1.02));
  neck.push_back(limb(high, {0, -0.008}, 0.97 * slender * p.neck_girth, 1, 1, 1, 1));
  solid.add(Tube::from_sections({}, neck), 0.042);

  // Skull, face, jaw and chin; then brow, nose, cheek bones, eye sockets, lips, ears.
  Solid head;
  head.add_ellipsoid({0, top - 0.098 * unit, z - 0.008}, {half, 0.098 * unit, length / 2 - 0.004}, 0);
  head.add_ellipsoid(at(0, 0.140, 0.030), Vector3d(0.058, 0.078, 0.060) * unit, 0.030);
  head.add_ellipsoid(at(0, 0.178, 0.036), Vector3d(plan.female ? 0.043 : 0.048, 0.042, 0.050) * unit, 0.025);
  head.add_ellipsoid(at(0, 0.203, 0.071), Vector3d(0.020, 0.016, 0.016) * unit, 0.020);
  head.add_ellipsoid(at(0.034, 0.138, 0.062), Vector3d(0.020, 0.016, 0.018) * unit, 0.020);
  head.add_ellipsoid(at(0.028, 0.098, 0.078), Vector3d(0.026, 0.009, 0.012) * unit, 0.014);
  head.carve_ellipsoid(at(0.031, 0.114, 0.098), Vector3d(0.018, 0.012, 0.015) * unit, 0.010);
  head.add_capsule(at(0, 0.110, 0.086), at(0, 0.150, 0.104), 0.008 * unit, 0.0115 * unit, 0.012);
  head.add_ellipsoid(at(0.010, 0.153, 0.092), Vector3d(0.010, 0.008, 0.010) * unit, 0.008);
  head.add_ellipsoid(at(0, 0.176, 0.084), Vector3d(0.022, 0.009, 0.012) * unit, 0.008);
  head.add_ellipsoid({half - 0.002, top - 0.129 * unit, z - 0.006}, Vector3d(0.009, 0.029, 0.017) * unit, 0.010);
  solid.add_field([head](const Vector3d& q) { return head.field(q); },
                  {Vector3d(-half - 0.02, top - 0.245 * unit, z - length / 2 - 0.01),
                   Vector3d(half + 0.02, top, z + length / 2 + 0.035)},
                  0.022);
}

void add_arm(const Plan& plan, Solid& solid) {
  const Proportions& p = plan.p;
  const double angle = plan.spec.arm_angle_deg * kTwoPi / 360;
  Tube::Frame frame;
  frame.origin = plan.shoulder;
  frame.axis = Vector3d(std::sin(angle), -std::cos(angle), 0);
  frame.u = Vector3d(std::cos(angle), std::sin(angle), 0);  // outwards
  frame.v = Vector3d::UnitZ();
  const double biceps = 0.90 * p.biceps_girth, forearm = 0.95 * p.forearm_girth;
  const double elbow = (plan.elbow - plan.shoulder).norm(), lower = p.forearm_length, wrist = elbow + lower;
  const double hand = p.hand_length, palm = p.hand_breadth / 2;
  const auto forward = [&](double s) {  // the elbow is a little bent
    const double t = std::max(0.0, s - elbow) / lower;
    return -0.006 * std::exp(-std::pow((s - elbow) / 0.12, 2)) + 0.034 * t * std::min(1.0, 0.35 + 0.65 * t);
  };
  const auto ring = [&](double s, double girth, double in, double out, double front, double back) {
    return limb(s, {0, forward(s)}, girth, in, out, front, back);
  };
  std::vector<LimbSection> sections{
      ring(-0.010, 0.60 * biceps, 1, 1, 1, 1),
      ring(0.030, 1.00 * biceps, 0.9, 1.0, 1.02, 1.0),
      ring(0.085, 1.10 * biceps, 0.95, 1.05, 1.04, 1.02),
      ring(0.56 * elbow, biceps, 0.95, 0.95, 1.08, 1.02),
      ring(0.80 * elbow, 0.90 * biceps, 0.97, 0.97, 1.04, 1.04),
      ring(elbow, 0.5 * (0.86 * biceps + 0.93 * forearm), 1.0, 1.0, 0.94, 1.06),
      ring(elbow + 0.24 * lower, forearm, 0.98, 0.98, 1.04, 1.0),
      ring(elbow + 0.55 * lower, 0.86 * forearm, 0.96, 0.96, 1.02, 1.02),
      ring(wrist - 0.045, 1.04 * p.wrist_girth, 0.86, 0.86, 1.1, 1.1),
      ring(wrist + 0.005, p.wrist_girth, 0.78, 0.78, 1.12, 1.12),
  };
  // at (part of the hand), half-thickness, half-breadth, curl towards the thigh
  const double rows[][4] = {{0.14, 0.0150, 0.80, 0.000},  {0.30, 0.0160, 0.98, -0.001}, {0.46, 0.0145, 1.00, -0.003},
                            {0.62, 0.0115, 0.90, -0.007}, {0.80, 0.0095, 0.76, -0.013}, {0.93, 0.0080, 0.56, -0.018},
                            {0.995, 0.0055, 0.28, -0.021}};
  for (const auto& row : rows) {
    const double s = wrist + row[0] * hand, scale = hand / 0.193;
    sections.push_back(
        {s, {row[3] * scale, forward(s) + 0.004}, row[1] * scale, row[1] * scale, row[2] * palm, row[2] * palm, 2.5});
  }
  solid.add(Tube::from_sections(frame, sections), 0.024);
  const double round = biceps / kTwoPi;
  solid.add_ellipsoid(plan.shoulder + 0.022 * frame.axis, {1.06 * round, 1.25 * round, 1.16 * round}, 0.030);
  const auto at = [&](double s, double u, double v) -> Vector3d {
    return frame.origin + s * frame.axis + u * frame.u + (forward(s) + v) * frame.v;
  };
  const Vector3d root = at(wrist + 0.17 * hand, -0.006, 0.55 * palm),
                 joint = at(wrist + 0.40 * hand, -0.016, 1.12 * palm);
  solid.add_capsule(root, joint, 0.017, 0.0125, 0.016);
  solid.add_capsule(joint, at(wrist + 0.57 * hand, -0.022, 1.16 * palm), 0.0115, 0.0085, 0.006);
}

std::map<std::string, Vector3d> joints_of(const Plan& plan) {
  const BodyLandmarks& m = plan.marks;
  const double head = m.stature - 0.115, hip_y = plan.p.trochanterion_height + 0.01;
  std::map<std::string, Vector3d> joints{
      {"SpineBase", {0, hip_y + 0.02, 0}},
      {"SpineMid", {0, 0.5 * (m.waist + m.chest), 0}},
      {"SpineShoulder", {0, m.shoulder - 0.01, -0.03}},
      {"Neck", {0, m.neck + 0.01, -0.02}},
      {"Head", {0, head, 0.01}},
  };
  const Vector3d thumb = plan.wrist + 0.5 * (plan.hand_tip - plan.wrist) + Vector3d(-0.02, 0, 0.045);
  const std::pair<const char*, Vector3d> left[] = {
      {"Shoulder", plan.shoulder},
      {"Elbow", plan.elbow},
      {"Wrist", plan.wrist},
      {"Hand", 0.55 * plan.wrist + 0.45 * plan.hand_tip},
      {"HandTip", plan.hand_tip},
      {"Thumb", thumb},
      {"Hip", {plan.leg_x, hip_y, 0}},
      {"Knee", {0.5 * (plan.leg_x + plan.ankle_x), m.knee, 0}},
      {"Ankle", {plan.ankle_x, m.ankle, plan.ankle_z}},
      {"Foot", {plan.ankle_x + 0.07 * plan.p.foot_length, 0.03, plan.ankle_z + 0.5 * plan.p.foot_length}},
  };
  for (const auto& [name, place] : left) {
    const std::string suffix = name;
    // The SDK writes HandTipLeft and ThumbLeft like all others.
    joints[suffix + "Left"] = place;
    joints[suffix + "Right"] = Vector3d(-place.x(), place.y(), place.z());
  }
  return joints;
}

}  // namespace

Mannequin make_mannequin(const BodySpec& spec, const Proportions& proportions, const GirthFactors& factors) {
  const Plan plan = make_plan(spec, proportions, factors);
  Solid solid;
  add_torso(plan, solid);
  add_leg(plan, solid);
  add_foot(plan, solid);
  add_neck_and_head(plan, solid);
  add_arm(plan, solid);
  solid.cut_below(0);
  Mannequin result;
  result.left_half = solid;
  const double reach = plan.hand_tip.x() + 0.06;
  result.box = Eigen::AlignedBox3d(Vector3d(-reach, -0.01, -0.35), Vector3d(reach, plan.marks.stature + 0.01, 0.35));
  result.landmarks = plan.marks;
  result.joints = joints_of(plan);
  return result;
}

}  // namespace dressform
