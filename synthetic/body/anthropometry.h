#pragma once
#include <string>

namespace dressform {

// The four measures a scene asks for, metres.
struct BodyMeasures {
  double stature = 0, chest = 0, waist = 0, hip = 0;
};

// What else a body of these measures has on average, metres.
struct Proportions {
  double cervicale_height = 0;
  double suprasternale_height = 0;
  double acromion_height = 0;
  double axilla_height = 0;
  double chest_height = 0;
  double waist_height = 0;
  double trochanterion_height = 0;
  double hip_height = 0;
  double crotch_height = 0;
  double knee_height = 0;
  double ankle_height = 0;
  double neck_girth = 0;
  double thigh_girth = 0;
  double lower_thigh_girth = 0;
  double calf_girth = 0;
  double ankle_girth = 0;
  double biceps_girth = 0;
  double forearm_girth = 0;
  double wrist_girth = 0;
  double biacromial_breadth = 0;
  double bideltoid_breadth = 0;
  double chest_breadth = 0;
  double chest_depth = 0;
  double waist_breadth = 0;
  double waist_depth = 0;
  double hip_breadth = 0;
  double hip_depth = 0;
  double head_breadth = 0;
  double head_length = 0;
  double head_top_above_ear = 0;
  double upper_arm_length = 0;
  double forearm_length = 0;
  double hand_length = 0;
  double hand_breadth = 0;
  double foot_length = 0;
  double foot_breadth = 0;
};

// Linear regression of every proportion on stature, chest, waist and hip girth. From the means, deviations and
// correlations of the public ANSUR II release (US Army, 2012; 4082 men, 1986 women).
// sex: "male" or "female"; throws InputError otherwise.
Proportions predict_proportions(const std::string& sex, const BodyMeasures& measures);

// Throws InputError naming the measure when no body has these measures: further than six deviations from the mean, or
// a chest, waist or hip further than six residual deviations from what the others predict.
void check_measures(const std::string& sex, const BodyMeasures& measures);

}  // namespace dressform
