#include "synthetic/body/figure.h"

#include <algorithm>
#include <cmath>

#include "scenes/error.h"
#include "synthetic/body/figure_sizes.h"

namespace dressform {
namespace {

constexpr double kDegree = M_PI / 180;

BodyLandmarks landmarks_of(const BodySizes& p) {
  BodyLandmarks marks;
  marks.stature = p.stature;
  marks.neck = p.cervicale_height;
  marks.shoulder = p.acromion_height;
  marks.armpit = p.axilla_height;
  marks.chest = p.chest_height - 0.005 * p.stature;  // clear of the armpit
  marks.waist = p.waist_height + 0.004 * p.stature;  // the narrowest place is above the navel
  marks.hip = p.hip_height;
  marks.crotch = p.crotch_height;
  marks.knee = p.knee_height;
  marks.ankle = p.ankle_height;
  return marks;
}

struct ArmPose {
  double angle, bend;
};

ArmPose arm_pose(const BodySpec& spec, BodySide side) {
  ArmPose pose{16 * kDegree, 8 * kDegree};
  if (spec.pose == "a_pose")
    pose = {42 * kDegree, 4 * kDegree};
  else if (spec.pose == "bent_arms")
    pose = {20 * kDegree, 18 * kDegree};
  else if (spec.pose == "one_arm_bent")
    pose = side == BodySide::left ? pose : ArmPose{24 * kDegree, 40 * kDegree};
  else if (spec.pose != "mannequin")
    throw InputError("body.pose", "found \"" + spec.pose + "\"; expected mannequin, a_pose, bent_arms or one_arm_bent");
  if (spec.arm_angle_deg > 0) pose.angle = spec.arm_angle_deg * kDegree;
  return pose;
}

// Arms hang clear of the trunk: the tangent of the angle at which they pass its sides.
double clear_slope(const FigurePlan& plan) {
  const BodyLandmarks& m = plan.marks;
  const double arm = plan.sizes.upper_arm_girth / (2 * M_PI), hand = 0.030;
  const double rows[][3] = {// height, half-breadth of the trunk, of the arm
                            {m.chest, plan.chest_half, 1.02 * arm},
                            {0.5 * (m.chest + m.waist), std::max(plan.waist_half, 0.9 * plan.chest_half), 0.95 * arm},
                            {m.waist, plan.waist_half, 0.9 * arm},
                            {0.5 * (m.waist + m.hip), 0.5 * (plan.waist_half + plan.hip_half), 0.65 * arm},
                            {m.hip, plan.hip_half, hand}};
  double slope = 0;
  for (const auto& row : rows)
    slope = std::max(slope, (row[1] + 1.05 * row[2] + 0.018 - plan.shoulder.x()) / (plan.shoulder.y() - row[0]));
  return slope;
}

void plan_arm(const ArmPose& pose, FigurePlan& plan) {
  const BodySizes& p = plan.sizes;
  const double deltoid = 0.94 * p.upper_arm_girth / (2 * M_PI);
  plan.shoulder = Vector3d(0.5 * p.shoulder_breadth - deltoid - 0.012, p.acromion_height - 0.024 * p.stature, -0.020);
  plan.arm_angle = std::max(pose.angle, std::atan(clear_slope(plan)));
  plan.elbow_bend = pose.bend;
  // The acromion is above the joint.
  const double upper = p.upper_arm_length - (p.acromion_height - plan.shoulder.y()) * std::cos(plan.arm_angle);
  const double lower = p.forearm_length;
  plan.wrist_s = std::sqrt(upper * upper + lower * lower + 2 * upper * lower * std::cos(pose.bend));
  plan.elbow_s = (upper * upper + plan.wrist_s * plan.wrist_s - lower * lower) / (2 * plan.wrist_s);
  plan.elbow_back = std::sqrt(std::max(0.0, upper * upper - plan.elbow_s * plan.elbow_s));
  const double lean = std::asin(plan.elbow_back / upper);  // the line to the wrist runs forward of the upper arm
  const Vector3d out(std::cos(plan.arm_angle), std::sin(plan.arm_angle), 0);
  const Vector3d down(std::sin(plan.arm_angle), -std::cos(plan.arm_angle), 0), ahead = Vector3d::UnitZ();
  const double tilt = 0.6 * lean;  // the upper arm goes back by the rest
  plan.arm.origin = plan.shoulder;
  plan.arm.axis = std::cos(tilt) * down + std::sin(tilt) * ahead;
  plan.arm.v = std::cos(tilt) * ahead - std::sin(tilt) * down;
  plan.arm.u = out;
  plan.elbow = plan.shoulder + plan.elbow_s * plan.arm.axis - plan.elbow_back * plan.arm.v;
  plan.wrist = plan.shoulder + plan.wrist_s * plan.arm.axis;
  const Vector3d hand = (plan.wrist - plan.elbow).normalized();
  plan.hand_tip = plan.wrist + p.hand_length * hand;
}

}  // namespace

double FigureShape::Level::exponent() const { return std::clamp(2.3 * std::exp(fullness), 1.8, 40.0); }

FigurePlan make_plan(const BodySpec& spec, const BodySizes& p, const FigureShape& shape, BodySide side) {
  FigurePlan plan;
  plan.female = spec.sex == "female";
  plan.sizes = p;
  plan.marks = landmarks_of(p);
  plan.shape = shape;
  plan.chest_half = shape.chest.breadth * p.chest_breadth / 2;
  plan.waist_half = shape.waist.breadth * p.waist_breadth / 2;
  plan.hip_half = shape.hip.breadth * p.hip_breadth / 2;
  plan.chest_depth = shape.chest.depth * p.chest_depth;
  plan.waist_depth = shape.waist.depth * p.waist_depth;
  plan.hip_depth = shape.hip.depth * p.hip_depth;

  // The thighs fill the hips' outline but for a gap of 14 mm between them.
  plan.thigh_half = 0.5 * (0.985 * plan.hip_half - 0.007);
  plan.leg_x = 0.007 + plan.thigh_half;
  plan.ankle_x = std::max(0.95 * plan.leg_x, 0.055 * p.stature);
  plan.knee_z = -0.004;
  plan.ankle_z = -0.024 * p.stature;
  plan_arm(arm_pose(spec, side), plan);

  const NeckPlace neck = neck_place(plan.marks);
  plan.neck_center = neck.center;
  plan.neck_axis = neck.axis;
  plan.head_z = 0.020;
  plan.chin = spec.chin_m;
  plan.bow = spec.bow_deg * kDegree;
  return plan;
}

LimbSection limb_ring(double s, const Vector2d& center, double girth, double in, double out, double front, double back,
                      double exponent) {
  return LimbSection{s, center, out, in, front, back, exponent}.scaled_to_perimeter(girth);
}

double arm_forward(const FigurePlan& plan, double s) {
  const double before = s / plan.elbow_s, after = (plan.wrist_s - s) / (plan.wrist_s - plan.elbow_s);
  // The straight bones, rounded where they meet.
  return -plan.elbow_back * smooth_union(before, after, 0.25);
}

}  // namespace dressform
