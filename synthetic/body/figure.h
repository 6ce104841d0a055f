#pragma once
#include "synthetic/body/anthropometry.h"
#include "synthetic/body/body.h"
#include "synthetic/geometry/solid.h"

namespace dressform {

// What the shape of a figure is solved with, so that it measures what it should (figure_sizes.h).
struct FigureShape {
  // The trunk at one measured height: factors on breadth and depth, and how full the outline is for them.
  struct Level {
    double breadth = 1, depth = 1, fullness = 0;
    double exponent() const;  // of the section: 2 is an ellipse, more is squarer
  };
  Level chest, waist, hip;
  // Factors on the girth of the limbs at the measured places.
  double thigh = 1, lower_thigh = 1, calf = 1, ankle = 1, upper_arm = 1, forearm = 1, wrist = 1, neck = 1;
  double head_breadth = 1, head_length = 1;
  double crotch_m = 0;  // shift of the trunk's lower end
  double crown_m = 0;   // shift of the crown
};

// Everything the parts of a figure share. World frame: stands on y = 0, faces +z; a half is planned as the left one
// (x > 0), also the right one.
struct FigurePlan {
  bool female = false;
  BodySizes sizes;  // what is aimed at
  BodyLandmarks marks;
  FigureShape shape;
  double hip_half = 0, waist_half = 0, chest_half = 0;     // half-breadths of the trunk
  double hip_depth = 0, waist_depth = 0, chest_depth = 0;  // depths of the trunk
  double thigh_half = 0, leg_x = 0, ankle_x = 0, knee_z = 0, ankle_z = 0;
  double arm_angle = 0;   // upper arm out from the vertical, radians
  double elbow_bend = 0;  // flexion, radians
  Vector3d shoulder{0, 0, 0}, elbow{0, 0, 0}, wrist{0, 0, 0}, hand_tip{0, 0, 0};
  Tube::Frame arm;                                    // from the shoulder to the wrist, u outwards
  double elbow_s = 0, wrist_s = 0, elbow_back = 0;    // along the arm; elbow behind that line
  Vector3d neck_center{0, 0, 0}, neck_axis{0, 1, 0};  // middle of the neck, upwards along it
  double head_z = 0;                                  // middle of the skull
  double chin = 0;                                    // how far the chin juts out, m
  double bow = 0;                                     // of the head, radians
};

// Whose arm is planned: all else of a figure is the same on both sides.
enum class BodySide { left, right };

FigurePlan make_plan(const BodySpec& spec, const BodySizes& sizes, const FigureShape& shape, BodySide side);

void add_torso(const FigurePlan& plan, Solid& solid);
void add_leg(const FigurePlan& plan, Solid& solid);
void add_foot(const FigurePlan& plan, Solid& solid);
void add_neck_and_head(const FigurePlan& plan, Solid& solid);
void add_arm(const FigurePlan& plan, Solid& solid);
void add_hand(const FigurePlan& plan, Solid& solid);

// Sections are given by girth and shape; the shape's absolute size does not matter.
LimbSection limb_ring(double s, const Vector2d& center, double girth, double in, double out, double front, double back,
                      double exponent = 2.1);

// How far the arm's middle line lies in front of the straight line from shoulder to wrist, at s along it.
double arm_forward(const FigurePlan& plan, double s);

}  // namespace dressform
