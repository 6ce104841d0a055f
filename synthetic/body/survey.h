#pragma once
#include <Eigen/Core>
#include <array>

namespace dressform {

// The measures of a standing body that its proportions are made of, metres. Heights are above the floor; girths,
// breadths and depths are those of the public ANSUR II survey (US Army, 2012): upper arm and forearm flexed, waist at
// the navel, lower thigh just above the knee, shoulder breadth across the deltoids.
struct BodySizes {
  double stature = 0;
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
  double chest_girth = 0;
  double waist_girth = 0;
  double hip_girth = 0;
  double thigh_girth = 0;
  double lower_thigh_girth = 0;
  double calf_girth = 0;
  double ankle_girth = 0;
  double upper_arm_girth = 0;
  double forearm_girth = 0;
  double wrist_girth = 0;
  double head_girth = 0;
  double biacromial_breadth = 0;
  double shoulder_breadth = 0;
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

struct SurveyMeasure {
  const char* name;
  double BodySizes::*member;
};

// In the order of the survey's rows.
constexpr std::array<SurveyMeasure, 41> kSurveyMeasures = {{
    {"stature", &BodySizes::stature},
    {"cervicale_height", &BodySizes::cervicale_height},
    {"suprasternale_height", &BodySizes::suprasternale_height},
    {"acromion_height", &BodySizes::acromion_height},
    {"axilla_height", &BodySizes::axilla_height},
    {"chest_height", &BodySizes::chest_height},
    {"waist_height", &BodySizes::waist_height},
    {"trochanterion_height", &BodySizes::trochanterion_height},
    {"hip_height", &BodySizes::hip_height},
    {"crotch_height", &BodySizes::crotch_height},
    {"knee_height", &BodySizes::knee_height},
    {"ankle_height", &BodySizes::ankle_height},
    {"neck_girth", &BodySizes::neck_girth},
    {"chest_girth", &BodySizes::chest_girth},
    {"waist_girth", &BodySizes::waist_girth},
    {"hip_girth", &BodySizes::hip_girth},
    {"thigh_girth", &BodySizes::thigh_girth},
    {"lower_thigh_girth", &BodySizes::lower_thigh_girth},
    {"calf_girth", &BodySizes::calf_girth},
    {"ankle_girth", &BodySizes::ankle_girth},
    {"upper_arm_girth", &BodySizes::upper_arm_girth},
    {"forearm_girth", &BodySizes::forearm_girth},
    {"wrist_girth", &BodySizes::wrist_girth},
    {"head_girth", &BodySizes::head_girth},
    {"biacromial_breadth", &BodySizes::biacromial_breadth},
    {"shoulder_breadth", &BodySizes::shoulder_breadth},
    {"chest_breadth", &BodySizes::chest_breadth},
    {"chest_depth", &BodySizes::chest_depth},
    {"waist_breadth", &BodySizes::waist_breadth},
    {"waist_depth", &BodySizes::waist_depth},
    {"hip_breadth", &BodySizes::hip_breadth},
    {"hip_depth", &BodySizes::hip_depth},
    {"head_breadth", &BodySizes::head_breadth},
    {"head_length", &BodySizes::head_length},
    {"head_top_above_ear", &BodySizes::head_top_above_ear},
    {"upper_arm_length", &BodySizes::upper_arm_length},
    {"forearm_length", &BodySizes::forearm_length},
    {"hand_length", &BodySizes::hand_length},
    {"hand_breadth", &BodySizes::hand_breadth},
    {"foot_length", &BodySizes::foot_length},
    {"foot_breadth", &BodySizes::foot_breadth},
}};

// Statistics of the measures over the people of one sex.
struct Survey {
  Eigen::VectorXd mean_m, deviation_m;
  Eigen::MatrixXd correlation;
};
Survey survey_of_men();
Survey survey_of_women();

}  // namespace dressform
