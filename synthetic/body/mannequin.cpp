#include "synthetic/body/mannequin.h"

#include <cmath>

namespace dressform {
namespace {

// Of the left half and the middle.
std::map<std::string, Vector3d> joints_of(const FigurePlan& plan) {
  const BodyLandmarks& m = plan.marks;
  const double hip_y = plan.sizes.trochanterion_height + 0.01;
  std::map<std::string, Vector3d> joints{
      {"SpineBase", {0, hip_y + 0.02, 0}},
      {"SpineMid", {0, 0.5 * (m.waist + m.chest), 0}},
      {"SpineShoulder", {0, m.shoulder - 0.01, -0.03}},
      {"Neck", {0, m.neck + 0.01, -0.01}},
      {"Head", {0, m.stature - 0.115, 0.015}},
  };
  const Vector3d thumb = plan.wrist + 0.5 * (plan.hand_tip - plan.wrist) - 0.02 * plan.arm.u + 0.05 * plan.arm.v;
  const std::pair<const char*, Vector3d> left[] = {
      {"Shoulder", plan.shoulder},
      {"Elbow", plan.elbow},
      {"Wrist", plan.wrist},
      {"Hand", 0.55 * plan.wrist + 0.45 * plan.hand_tip},
      {"HandTip", plan.hand_tip},
      {"Thumb", thumb},
      {"Hip", {plan.leg_x, hip_y, 0}},
      {"Knee", {0.45 * plan.leg_x + 0.55 * plan.ankle_x, m.knee, plan.knee_z}},
      {"Ankle", {plan.ankle_x, m.ankle, plan.ankle_z}},
      {"Foot", {plan.ankle_x + 0.08 * plan.sizes.foot_length, 0.03, plan.ankle_z + 0.5 * plan.sizes.foot_length}},
  };
  for (const auto& [name, place] : left)  // the SDK writes HandTipLeft and ThumbLeft like all others
    joints[std::string(name) + "Left"] = place;
  return joints;
}

Solid half_of(const FigurePlan& plan) {
  Solid solid;
  add_torso(plan, solid);
  add_leg(plan, solid);
  add_foot(plan, solid);
  add_neck_and_head(plan, solid);
  add_arm(plan, solid);
  add_hand(plan, solid);
  solid.cut_below(0);
  return solid;
}

// How far out and ahead the hand reaches.
Vector2d reach_of(const FigurePlan& plan) {
  return {std::max(plan.hand_tip.x(), plan.elbow.x()) + 0.08, std::max(0.35, plan.hand_tip.z() + 0.06)};
}

}  // namespace

Mannequin make_mannequin(const BodySpec& spec, const BodySizes& sizes, const FigureShape& shape) {
  const FigurePlan left = make_plan(spec, sizes, shape, BodySide::left);
  const FigurePlan right = make_plan(spec, sizes, shape, BodySide::right);
  Mannequin result;
  result.left_half = half_of(left);
  result.right_half = half_of(right);
  const Vector2d to_left = reach_of(left), to_right = reach_of(right);
  result.box =
      Eigen::AlignedBox3d(Vector3d(-to_right.x(), -0.01, -0.35),
                          Vector3d(to_left.x(), left.marks.stature + 0.01, std::max(to_left.y(), to_right.y())));
  result.landmarks = left.marks;
  result.joints = joints_of(left);
  for (const auto& [name, place] : joints_of(right))
    if (const auto at = name.rfind("Left"); at != std::string::npos)
      result.joints[name.substr(0, at) + "Right"] = Vector3d(-place.x(), place.y(), place.z());
  return result;
}

double crotch_height(const Mannequin& mannequin) {
  const auto closed_at = [&](double y) {
    for (double z = -0.14; z < 0.14; z += 0.01)
      if (mannequin.left_half.field({0, y, z}) < 0) return true;
    return false;
  };
  double open = mannequin.landmarks.knee, closed = mannequin.landmarks.hip;
  for (double y = closed; y > open && closed_at(y); y -= 0.006) closed = y;
  open = closed - 0.006;
  for (int i = 0; i < 7; ++i) {
    const double middle = 0.5 * (open + closed);
    (closed_at(middle) ? closed : open) = middle;
  }
  return closed;
}

double top_height(const Mannequin& mannequin) {
  double top = mannequin.landmarks.stature - 0.05;
  for (double z = -0.06; z < 0.10; z += 0.01) {
    double inside = mannequin.landmarks.stature - 0.05, outside = mannequin.landmarks.stature + 0.04;
    if (mannequin.left_half.field({0, inside, z}) >= 0) continue;
    for (int i = 0; i < 10; ++i) {
      const double middle = 0.5 * (inside + outside);
      (mannequin.left_half.field({0, middle, z}) < 0 ? inside : outside) = middle;
    }
    top = std::max(top, inside);
  }
  return top;
}

}  // namespace dressform
