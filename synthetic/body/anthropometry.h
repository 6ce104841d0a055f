#pragma once
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "synthetic/body/survey.h"

namespace dressform {

// A measure that is known of somebody, metres.
struct KnownMeasure {
  double BodySizes::*measure;
  double value_m;
};

// What else a body has on average when some measures are known, and by how much people of those measures differ from it
// (standard deviation; 0 for the known ones). Metres.
struct Prediction {
  BodySizes mean, deviation;
};

// The multivariate normal distribution of the survey, conditioned on the known measures.
// sex: "male" or "female"; throws InputError otherwise.
Prediction predict_sizes(const std::string& sex, const std::vector<KnownMeasure>& known);

// Stature, chest, waist and hip girth, and the segment lengths that the scene asks for.
std::vector<KnownMeasure> known_measures(const BodySpec& spec);

// Throws InputError naming the scene's key when no body has these measures: further than six deviations from the mean,
// or further than six residual deviations from what the others predict (for the girths and segment lengths).
void check_measures(const BodySpec& spec);

// The spec with stature and girths drawn from the survey when it asks for a sampled customer: `sample` "man" or
// "woman", the customer number `sample_seed`. Otherwise the spec as it is.
BodySpec drawn_customer(const BodySpec& spec);

}  // namespace dressform
