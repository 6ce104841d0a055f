#include "synthetic/body/anthropometry.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/random.h"

namespace dressform {
namespace {

Survey survey_of(const std::string& sex) {
  if (sex == "male") return survey_of_men();
  if (sex == "female") return survey_of_women();
  throw InputError("body.sex", "found \"" + sex + "\"; expected \"male\" or \"female\"");
}

int row_of(double BodySizes::*measure) {
  int row = 0;
  while (kSurveyMeasures[row].member != measure) ++row;
  return row;
}

// Rows of the known measures, and their covariance.
struct Known {
  std::vector<int> rows;
  Eigen::VectorXd off;  // from the mean
  Eigen::MatrixXd covariance;

  Known(const Survey& survey, const std::vector<KnownMeasure>& known) : off(known.size()) {
    for (const KnownMeasure& item : known) {
      rows.push_back(row_of(item.measure));
      off[static_cast<int>(rows.size()) - 1] = item.value_m - survey.mean_m[rows.back()];
    }
    covariance.resize(rows.size(), rows.size());
    for (size_t i = 0; i < rows.size(); ++i)
      for (size_t j = 0; j < rows.size(); ++j)
        covariance(i, j) =
            survey.correlation(rows[i], rows[j]) * survey.deviation_m[rows[i]] * survey.deviation_m[rows[j]];
  }
};

// A measure of the scene that is checked for being a person's; `key` is its name in the scene.
struct Asked {
  const char* key;
  KnownMeasure known;
};

std::vector<Asked> asked_measures(const BodySpec& spec) {
  std::vector<Asked> asked{{"body.stature_m", {&BodySizes::stature, spec.stature_m}},
                           {"body.chest_m", {&BodySizes::chest_girth, spec.chest_m}},
                           {"body.waist_m", {&BodySizes::waist_girth, spec.waist_m}},
                           {"body.hip_m", {&BodySizes::hip_girth, spec.hip_m}}};
  const Asked lengths[] = {{"body.inseam_m", {&BodySizes::crotch_height, spec.inseam_m}},
                           {"body.knee_height_m", {&BodySizes::knee_height, spec.knee_height_m}},
                           {"body.upper_arm_m", {&BodySizes::upper_arm_length, spec.upper_arm_m}},
                           {"body.forearm_m", {&BodySizes::forearm_length, spec.forearm_m}},
                           {"body.neck_m", {&BodySizes::neck_girth, spec.neck_m}}};
  for (const Asked& length : lengths)
    if (length.known.value_m != 0) asked.push_back(length);
  return asked;
}

}  // namespace

Prediction predict_sizes(const std::string& sex, const std::vector<KnownMeasure>& known) {
  const Survey survey = survey_of(sex);
  const Known given(survey, known);
  const Eigen::LLT<Eigen::MatrixXd> solver(given.covariance);
  const Eigen::VectorXd pull = solver.solve(given.off);
  Prediction prediction;
  for (int row = 0; row < static_cast<int>(kSurveyMeasures.size()); ++row) {
    Eigen::VectorXd shared(given.rows.size());
    for (size_t i = 0; i < given.rows.size(); ++i)
      shared[i] = survey.correlation(row, given.rows[i]) * survey.deviation_m[row] * survey.deviation_m[given.rows[i]];
    const double variance = std::pow(survey.deviation_m[row], 2) - shared.dot(solver.solve(shared));
    prediction.mean.*kSurveyMeasures[row].member = survey.mean_m[row] + shared.dot(pull);
    prediction.deviation.*kSurveyMeasures[row].member = std::sqrt(std::max(0.0, variance));
  }
  for (const KnownMeasure& item : known) {
    prediction.mean.*item.measure = item.value_m;
    prediction.deviation.*item.measure = 0;
  }
  return prediction;
}

std::vector<KnownMeasure> known_measures(const BodySpec& spec) {
  std::vector<KnownMeasure> known;
  for (const Asked& asked : asked_measures(spec)) known.push_back(asked.known);
  return known;
}

void check_measures(const BodySpec& spec) {
  constexpr double kDeviations = 6;
  const std::vector<Asked> asked = asked_measures(spec);
  const auto check = [&](const Asked& item, const Prediction& expected, const char* why) {
    const double center = expected.mean.*item.known.measure, spread = expected.deviation.*item.known.measure;
    const double low = center - kDeviations * spread, high = center + kDeviations * spread, found = item.known.value_m;
    if (found >= low && found <= high) return;
    throw InputError(item.key, fmt::format("found {} m, which no {} body has{}; expected {:.2f} to {:.2f} m", found,
                                           spec.sex, why, low, high));
  };
  const Prediction everybody = predict_sizes(spec.sex, {});
  for (const Asked& item : asked) check(item, everybody, "");
  for (size_t i = 1; i < asked.size(); ++i) {
    std::vector<KnownMeasure> others;
    for (size_t j = 0; j < asked.size(); ++j)
      if (j != i) others.push_back(asked[j].known);
    check(asked[i], predict_sizes(spec.sex, others), " with the other measures");
  }
}

BodySpec drawn_customer(const BodySpec& spec) {
  if (spec.sample.empty()) return spec;
  BodySpec drawn = spec;
  if (spec.sample != "man" && spec.sample != "woman")
    throw InputError("body.sample", "found \"" + spec.sample + "\"; expected \"man\" or \"woman\"");
  drawn.sex = spec.sample == "man" ? "male" : "female";
  const Survey survey = survey_of(drawn.sex);
  const Known given(survey, {{&BodySizes::stature, 0},
                             {&BodySizes::chest_girth, 0},
                             {&BodySizes::waist_girth, 0},
                             {&BodySizes::hip_girth, 0}});
  const auto noise = normal4(static_cast<std::uint64_t>(spec.sample_seed), stream_of(spec.sample.c_str()), 0);
  const Eigen::VectorXd off =
      Eigen::LLT<Eigen::MatrixXd>(given.covariance).matrixL() * Eigen::Map<const Eigen::Vector4d>(noise.data());
  double* const drawn_m[4] = {&drawn.stature_m, &drawn.chest_m, &drawn.waist_m, &drawn.hip_m};
  for (int i = 0; i < 4; ++i) *drawn_m[i] = survey.mean_m[given.rows[i]] + off[i];
  drawn.sample.clear();
  return drawn;
}

}  // namespace dressform
