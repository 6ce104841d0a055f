#include "synthetic/body/anthropometry.h"

#include <cmath>
#include <vector>

#include "fmt/format.h"
#include "scenes/error.h"

namespace dressform {
namespace {

// proportion = constant + stature * w[0] + chest * w[1] + waist * w[2] + hip * w[3], metres.
struct Row {
  double Proportions::*member;
  double constant, weights[4];
};

struct Statistics {
  double mean[4], deviation[4];  // stature, chest, waist, hip, metres
  double residual[4];            // deviation of one when the other three are known
  double weights[4][4];          // of the others in the prediction of one; 0 on the diagonal
  std::vector<Row> rows;
};

const Statistics kMale = {{1.75621, 1.05871, 0.94058, 1.01952},
                          {0.06855, 0.08744, 0.11171, 0.07668},
                          {0.06310, 0.03901, 0.04305, 0.03386},
                          {{0.00000, 0.08682, -0.28188, 0.58092},
                           {0.03318, 0.00000, 0.52492, 0.27333},
                           {-0.13121, 0.63926, 0.00000, 0.70665},
                           {0.16727, 0.20592, 0.43715, 0.00000}},
                          {
                              {&Proportions::cervicale_height, -0.09116, {0.89917, 0.01792, 0.02759, -0.01530}},
                              {&Proportions::suprasternale_height, -0.12378, {0.86098, 0.03738, 0.01939, -0.00735}},
                              {&Proportions::acromion_height, -0.14951, {0.87982, 0.04097, 0.04815, -0.04273}},
                              {&Proportions::axilla_height, -0.13887, {0.85081, -0.00691, 0.01812, -0.03529}},
                              {&Proportions::chest_height, -0.10535, {0.78321, 0.04930, -0.05155, 0.01694}},
                              {&Proportions::waist_height, -0.15803, {0.70123, 0.07721, -0.17163, 0.06151}},
                              {&Proportions::trochanterion_height, -0.15668, {0.63325, 0.04123, -0.00598, -0.09078}},
                              {&Proportions::hip_height, -0.15647, {0.62513, 0.04521, 0.00311, -0.10232}},
                              {&Proportions::crotch_height, -0.16464, {0.60122, 0.03901, -0.06792, -0.02229}},
                              {&Proportions::knee_height, -0.11395, {0.34594, 0.02783, -0.00440, -0.02995}},
                              {&Proportions::ankle_height, 0.00186, {0.03519, -0.00237, 0.00985, 0.00243}},
                              {&Proportions::neck_girth, 0.15753, {-0.00523, 0.17635, 0.02952, 0.03417}},
                              {&Proportions::thigh_girth, -0.03070, {-0.06805, 0.05399, -0.04645, 0.74730}},
                              {&Proportions::lower_thigh_girth, 0.03006, {0.00322, 0.04002, -0.00797, 0.33221}},
                              {&Proportions::calf_girth, 0.06192, {-0.00270, 0.09312, -0.03583, 0.26503}},
                              {&Proportions::ankle_girth, 0.03951, {0.03012, 0.03397, -0.03125, 0.12787}},
                              {&Proportions::biceps_girth, 0.00226, {-0.03998, 0.29441, -0.12672, 0.22911}},
                              {&Proportions::forearm_girth, 0.03317, {0.01928, 0.17853, -0.07353, 0.12082}},
                              {&Proportions::wrist_girth, 0.03561, {0.04249, 0.03772, -0.00542, 0.03026}},
                              {&Proportions::biacromial_breadth, 0.09116, {0.11003, 0.14076, -0.07859, 0.05509}},
                              {&Proportions::bideltoid_breadth, 0.07763, {0.02699, 0.28608, -0.04496, 0.12241}},
                              {&Proportions::chest_breadth, 0.05367, {0.04454, 0.15238, -0.00511, 0.00101}},
                              {&Proportions::chest_depth, -0.02679, {-0.00281, 0.23882, 0.03352, 0.00120}},
                              {&Proportions::waist_breadth, -0.00829, {0.01451, 0.00818, 0.25404, 0.06046}},
                              {&Proportions::waist_depth, 0.00375, {-0.01278, -0.00772, 0.33266, -0.04734}},
                              {&Proportions::hip_breadth, 0.01675, {0.02848, -0.03472, 0.02326, 0.28822}},
                              {&Proportions::hip_depth, -0.00765, {-0.02711, 0.01697, 0.07336, 0.21004}},
                              {&Proportions::head_breadth, 0.13097, {-0.00331, 0.02059, -0.01033, 0.01677}},
                              {&Proportions::head_length, 0.12274, {0.02980, 0.01500, -0.00639, 0.01427}},
                              {&Proportions::head_top_above_ear, 0.09629, {0.01469, 0.00289, -0.00365, 0.00924}},
                              {&Proportions::upper_arm_length, -0.02673, {0.20227, 0.02489, 0.00619, -0.02495}},
                              {&Proportions::forearm_length, -0.02019, {0.15789, 0.01719, -0.02502, 0.01581}},
                              {&Proportions::hand_length, 0.01280, {0.09281, 0.02265, -0.01347, 0.00606}},
                              {&Proportions::hand_breadth, 0.02502, {0.02250, 0.02038, -0.00997, 0.01130}},
                              {&Proportions::foot_length, 0.01275, {0.12419, 0.03015, -0.03260, 0.03832}},
                              {&Proportions::foot_breadth, 0.02751, {0.02280, 0.01827, -0.01644, 0.02986}},
                          }};

const Statistics kFemale = {{1.62847, 0.94686, 0.86091, 1.02125},
                            {0.06420, 0.08270, 0.09993, 0.07589},
                            {0.05873, 0.04333, 0.04622, 0.04195},
                            {{0.00000, 0.08693, -0.18637, 0.44729},
                             {0.04732, 0.00000, 0.58281, 0.17825},
                             {-0.11540, 0.66296, 0.00000, 0.55759},
                             {0.22825, 0.16711, 0.45952, 0.00000}},
                            {
                                {&Proportions::cervicale_height, -0.08822, {0.91122, -0.01855, 0.02093, -0.00045}},
                                {&Proportions::suprasternale_height, -0.10541, {0.85900, 0.01320, 0.00499, 0.01904}},
                                {&Proportions::acromion_height, -0.11087, {0.86791, 0.03308, 0.00984, -0.00704}},
                                {&Proportions::axilla_height, -0.12645, {0.84882, 0.00494, -0.01362, -0.00954}},
                                {&Proportions::chest_height, -0.09096, {0.81521, -0.04699, -0.02384, 0.00008}},
                                {&Proportions::waist_height, -0.16039, {0.71882, 0.00740, -0.14978, 0.08999}},
                                {&Proportions::trochanterion_height, -0.11614, {0.60593, -0.04178, 0.05133, -0.02927}},
                                {&Proportions::hip_height, -0.13123, {0.60766, -0.04416, 0.09849, -0.06617}},
                                {&Proportions::crotch_height, -0.15048, {0.61666, -0.06995, 0.02961, -0.03004}},
                                {&Proportions::knee_height, -0.10126, {0.34461, -0.02601, 0.03123, -0.01286}},
                                {&Proportions::ankle_height, 0.00708, {0.03542, -0.00660, 0.00976, -0.00408}},
                                {&Proportions::neck_girth, 0.12592, {0.02793, 0.10069, 0.04718, 0.02197}},
                                {&Proportions::thigh_girth, -0.03430, {-0.03877, -0.01947, 0.01251, 0.70625}},
                                {&Proportions::lower_thigh_girth, 0.00554, {0.00750, -0.01186, -0.02069, 0.40343}},
                                {&Proportions::calf_girth, 0.04066, {0.02911, 0.03260, -0.03636, 0.27969}},
                                {&Proportions::ankle_girth, 0.04828, {0.04341, 0.00992, -0.01364, 0.09706}},
                                {&Proportions::biceps_girth, 0.00167, {-0.01910, 0.10006, 0.04687, 0.19576}},
                                {&Proportions::forearm_girth, 0.03976, {0.03323, 0.05744, 0.01372, 0.10184}},
                                {&Proportions::wrist_girth, 0.03088, {0.04818, 0.02280, 0.00281, 0.02101}},
                                {&Proportions::biacromial_breadth, 0.08817, {0.14722, 0.02963, -0.00371, 0.01231}},
                                {&Proportions::bideltoid_breadth, 0.08499, {0.04800, 0.15338, 0.05676, 0.09113}},
                                {&Proportions::chest_breadth, 0.04258, {0.04751, 0.15589, 0.01724, -0.01278}},
                                {&Proportions::chest_depth, -0.03817, {-0.00994, 0.30363, 0.00285, 0.01155}},
                                {&Proportions::waist_breadth, -0.02215, {0.02402, 0.00994, 0.28988, 0.02345}},
                                {&Proportions::waist_depth, 0.00536, {-0.03162, 0.00182, 0.29140, 0.00643}},
                                {&Proportions::hip_breadth, -0.00221, {0.01287, -0.00847, -0.01021, 0.34458}},
                                {&Proportions::hip_depth, -0.00039, {-0.03149, 0.01021, 0.05685, 0.22127}},
                                {&Proportions::head_breadth, 0.12427, {0.00996, 0.00507, 0.00632, -0.00290}},
                                {&Proportions::head_length, 0.11722, {0.03426, 0.00261, -0.00565, 0.01879}},
                                {&Proportions::head_top_above_ear, 0.08748, {0.01897, 0.00150, 0.00790, -0.00011}},
                                {&Proportions::upper_arm_length, -0.04071, {0.20441, 0.00752, 0.00915, 0.00395}},
                                {&Proportions::forearm_length, -0.02455, {0.16032, -0.01073, 0.00970, 0.00647}},
                                {&Proportions::hand_length, 0.01123, {0.09398, 0.00258, -0.00382, 0.01729}},
                                {&Proportions::hand_breadth, 0.02694, {0.02303, 0.01134, -0.00471, 0.00688}},
                                {&Proportions::foot_length, 0.01085, {0.12908, 0.00434, -0.00467, 0.02463}},
                                {&Proportions::foot_breadth, 0.03615, {0.02263, 0.00763, -0.00067, 0.01278}},
                            }};

const Statistics& statistics_of(const std::string& sex) {
  if (sex == "male") return kMale;
  if (sex == "female") return kFemale;
  throw InputError("body.sex", "found \"" + sex + "\"; expected \"male\" or \"female\"");
}

}  // namespace

Proportions predict_proportions(const std::string& sex, const BodyMeasures& measures) {
  const double known[4] = {measures.stature, measures.chest, measures.waist, measures.hip};
  Proportions result;
  for (const Row& row : statistics_of(sex).rows) {
    result.*row.member = row.constant;
    for (int i = 0; i < 4; ++i) result.*row.member += row.weights[i] * known[i];
  }
  return result;
}

void check_measures(const std::string& sex, const BodyMeasures& measures) {
  constexpr double kDeviations = 6;
  static const char* const kNames[4] = {"body.stature_m", "body.chest_m", "body.waist_m", "body.hip_m"};
  const Statistics& statistics = statistics_of(sex);
  const double known[4] = {measures.stature, measures.chest, measures.waist, measures.hip};
  const auto check = [&](int i, double center, double deviation, const char* why) {
    const double low = center - kDeviations * deviation, high = center + kDeviations * deviation;
    if (known[i] >= low && known[i] <= high) return;
    throw InputError(kNames[i], fmt::format("found {} m, which no {} body has{}; expected {:.2f} to {:.2f} m", known[i],
                                            sex, why, low, high));
  };
  for (int i = 0; i < 4; ++i) check(i, statistics.mean[i], statistics.deviation[i], "");
  for (int i = 1; i < 4; ++i) {
    double predicted = statistics.mean[i];
    for (int j = 0; j < 4; ++j) predicted += statistics.weights[i][j] * (known[j] - statistics.mean[j]);
    check(i, predicted, statistics.residual[i], " with the other measures");
  }
}

}  // namespace dressform
