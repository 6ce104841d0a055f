#pragma once
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/body/body_limbs.h"

namespace dressform {

// All that the stages know of a standing body beside its surface: found once, by the landmarks stage. Metres, model
// frame (y up, floor y = 0). Left and right are the body's own.
struct Landmarks : BodyLimbs {
  double stature = 0;  // floor_y to top_y
  // Heights that correspond between people, crotch_y and armpit_y among them: by girth, and held within what people are
  // like (ANSUR II), as thighs that touch hide the crotch and a belly hides the waist.
  double hip_y = 0, waist_y = 0, chest_y = 0, neck_y = 0;
  Vector3d neck = Vector3d::Zero();      // centre of the neck's section
  Vector3d axis = Vector3d::Zero();      // a point on the trunk's upright axis (x and z matter)
  bool has_trunk = false;                // false: no closed section between crotch and armpits, the axis is a guess
  bool sure = false;                     // of front and back, and so of left and right: what tells them agrees
  std::vector<BodyPart> triangle_parts;  // of the mesh's triangles

  // Of one of the mesh's triangles; of none (-1), the torso.
  BodyPart part_of(int triangle) const { return triangle < 0 ? BodyPart::torso : triangle_parts[triangle]; }
  // Direction at `angle` about the vertical, 0 = front, a quarter turn = left.
  Vector3d direction(double angle) const { return std::cos(angle) * front + std::sin(angle) * left; }

  template <class Archive>
  void serialize(Archive& archive) {
    auto told_by = static_cast<unsigned char>(front_from);
    std::vector<unsigned char> parts;
    for (const BodyPart part : triangle_parts) parts.push_back(static_cast<unsigned char>(part));
    archive(front, left, told_by, feet_forward_m, floor_y, top_y, crotch_y, armpit_y);
    archive(left_arm, right_arm, left_leg, right_leg);
    archive(stature, hip_y, waist_y, chest_y, neck_y, neck, axis, has_trunk, sure, parts);
    if (told_by > static_cast<unsigned char>(FrontFrom::likeness))
      throw std::runtime_error("serialized data are damaged: an unknown source of a body's front");
    front_from = static_cast<FrontFrom>(told_by);
    triangle_parts.clear();
    for (const unsigned char part : parts) {
      if (part > static_cast<unsigned char>(BodyPart::right_leg))
        throw std::runtime_error("serialized data are damaged: an unknown part of the body");
      triangle_parts.push_back(static_cast<BodyPart>(part));
    }
  }
};

// A body and what is known of it: what the stages are given. Model frame of its scan.
struct KnownBody {
  Mesh body;  // closed
  Landmarks landmarks;
};

// Throws InputError naming `where` for a body without triangles, or landmarks of another mesh.
void require_known(const KnownBody& body, const std::string& where);
KnownBody known_body(Mesh body);  // with find_landmarks of it

// Landmarks of a closed standing body, y up, from its horizontal sections. `front_hint`: as of find_limbs. Bodies that
// the sections do not show as such have the usual proportions, has_trunk = false and no limbs. `sure` is left to who
// knows what else tells the front. Throws InputError for a mesh without triangles.
Landmarks find_landmarks(const Mesh& body, const std::optional<Vector3d>& front_hint = {});

// The landmarks of the same mesh after a turn about the vertical and a shift; 4 x 4, rigid.
Landmarks transformed(const Landmarks& landmarks, const Eigen::Matrix4d& motion);

// With the front turned to `front` (horizontal, unit): what is left stays left, the limbs stay where they are.
Landmarks with_front(Landmarks landmarks, const Vector3d& front);

}  // namespace dressform
