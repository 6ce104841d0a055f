// Faults in the scanned bodies and in their landmarks.
#include <algorithm>
#include <cmath>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"
#include "pipeline/fuse/fuse.h"
#include "pipeline/landmarks/landmarks.h"

namespace dressform {
namespace {

constexpr double kDentRadiusM = 0.12;  // a chest's or a thigh's width: what a bad frame leaves

void scale_body(BodyModel& model, double size_percent, const Placement&) {
  for (auto& vertex : model.body.vertices) vertex *= 1 + size_percent / 100;  // the floor stays at y = 0
}

void shake_body(BodyModel& model, double size_mm, const Placement& place) { shake(model.body, size_mm / 1000, place); }
void dent_body(BodyModel& model, double size_mm, const Placement& place) {
  dent(model.body, kDentRadiusM, size_mm / 1000, place);
}

// A loop that did not close: what lies above the middle stands beside what lies below.
void shear_body(BodyModel& model, double size_mm, const Placement& place) {
  double top = 0;
  for (const auto& vertex : model.body.vertices) top = std::max(top, vertex.y());
  Vector3d sideways = place.direction(1);
  sideways.y() = 0;
  const Vector3d by = size_mm / 1000 * (sideways.norm() > 0 ? sideways.normalized() : Vector3d(Vector3d::UnitX()));
  for (auto& vertex : model.body.vertices)  // over a tenth of the height, so that nothing folds
    vertex += std::clamp((vertex.y() / std::max(top, 1e-9) - 0.5) * 10 + 0.5, 0.0, 1.0) * by;
}

void blow_body(BodyModel& model, double size_mm, const Placement&) { blow(model.body, size_mm / 1000); }

void lift_waist(Landmarks& landmarks, double size_mm, const Placement&) { landmarks.waist_y += size_mm / 1000; }
void lift_chest(Landmarks& landmarks, double size_mm, const Placement&) { landmarks.chest_y += size_mm / 1000; }
void lift_crotch(Landmarks& landmarks, double size_mm, const Placement&) { landmarks.crotch_y += size_mm / 1000; }
void move_axis(Landmarks& landmarks, double size_mm, const Placement&) {
  landmarks.axis += size_mm / 1000 * landmarks.front;
}

void turn_front(Landmarks& landmarks, double size_deg, const Placement&) {
  const Eigen::AngleAxisd turn(size_deg * M_PI / 180, Vector3d::UnitY());
  landmarks.front = turn * landmarks.front;
  landmarks.left = turn * landmarks.left;
}

void swap_sides(Landmarks& landmarks, double, const Placement&) {
  landmarks.left = -landmarks.left;
  landmarks.front = -landmarks.front;
  std::swap(landmarks.left_arm, landmarks.right_arm);
  std::swap(landmarks.left_leg, landmarks.right_leg);
  for (auto& part : landmarks.triangle_parts) {
    if (is_arm(part))
      part = arm_part(1 - side_of(part));
    else if (is_leg(part))
      part = leg_part(1 - side_of(part));
  }
}

}  // namespace

std::vector<Fault> body_faults() {
  std::vector<Fault> faults;
  for (const std::string who : {"naked", "user"}) {
    const std::string fuse = "fuse_" + who, landmarks = "landmarks_" + who, body = who == "user" ? "user" : "mannequin";
    faults.push_back(
        artifact_fault<BodyModel>(fuse, "scaled", "%", {0.5, 1.5, 5}, "the " + body + " too large", scale_body));
    faults.push_back(
        artifact_fault<BodyModel>(fuse, "blown", "mm", {1, 4, 12}, "the " + body + " too thick", blow_body));
    faults.push_back(artifact_fault<BodyModel>(fuse, "noisy", "mm", {0.5, 2, 6}, "noise on the " + body, shake_body));
    faults.push_back(
        artifact_fault<BodyModel>(fuse, "dented", "mm", {5, 15, 40}, "a dent of 24 cm in the " + body, dent_body));
    faults.push_back(
        artifact_fault<Landmarks>(landmarks, "waist_lifted", "mm", {15, 50, 150}, "its waist too high", lift_waist));
    faults.push_back(
        artifact_fault<Landmarks>(landmarks, "chest_lifted", "mm", {15, 50, 150}, "its chest too high", lift_chest));
    faults.push_back(
        artifact_fault<Landmarks>(landmarks, "front_turned", "deg", {5, 20, 60}, "its front turned away", turn_front));
    faults.push_back(artifact_fault<Landmarks>(landmarks, "sides_swapped", "there", {1},
                                               "left and right, front and back swapped", swap_sides));
  }
  faults.push_back(
      artifact_fault<BodyModel>("fuse_naked", "sheared", "mm", {4, 12, 40}, "a loop that did not close", shear_body));
  faults.push_back(artifact_fault<Landmarks>("landmarks_naked", "crotch_lifted", "mm", {15, 50, 150},
                                             "its crotch too high", lift_crotch));
  faults.push_back(artifact_fault<Landmarks>("landmarks_naked", "axis_moved", "mm", {10, 40, 120},
                                             "its trunk's axis too far in front", move_axis));
  return faults;
}

}  // namespace dressform
