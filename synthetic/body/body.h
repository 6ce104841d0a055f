#pragma once
#include <map>
#include <string>

#include "scenes/frame.h"
#include "scenes/mesh.h"
#include "scenes/scene.h"

namespace dressform {

// Landmark heights of a body standing on y = 0, metres.
struct BodyLandmarks {
  double stature = 0, neck = 0, shoulder = 0, armpit = 0, chest = 0, waist = 0, hip = 0, crotch = 0, knee = 0,
         ankle = 0;
};

struct Body {
  Mesh mesh;  // closed, genus 0, outward, world frame: stands on y = 0, faces +z, left arm towards +x
  BodyLandmarks landmarks;
  std::map<std::string, Vector3d> joints;  // the SDK's 25 names, world frame
};

// The procedural mannequin (girths solved to within 1 mm), or the scene's own mesh with landmarks measured from it.
// Throws InputError for measures no body can have, a mesh that is not closed, or one that no person in metres, y up and
// on the floor y = 0 can be: with what was found and which unit or axis it looks like.
Body make_body(const BodySpec& spec);

// Tape girth: length of the convex hull of the torso's section at height y (arms left out), metres.
double tape_girth(const Mesh& body, double y);

}  // namespace dressform
