#include "scenes/frame.h"

namespace dressform {

const std::vector<std::string>& joint_names() {
  static const std::vector<std::string> names{
      "SpineBase",   "SpineMid",      "Neck",         "Head",       "ShoulderLeft", "ElbowLeft", "WristLeft",
      "HandLeft",    "ShoulderRight", "ElbowRight",   "WristRight", "HandRight",    "HipLeft",   "KneeLeft",
      "AnkleLeft",   "FootLeft",      "HipRight",     "KneeRight",  "AnkleRight",   "FootRight", "SpineShoulder",
      "HandTipLeft", "ThumbLeft",     "HandTipRight", "ThumbRight"};  // in the SDK's order, JointType 0 to 24
  return names;
}

}  // namespace dressform
