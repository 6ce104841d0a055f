#include <stdexcept>

#include "eval/studies/draw/draw_parts.h"
#include "synthetic/body/anthropometry.h"

namespace dressform {
namespace {

constexpr int kMostTries = 1000;  // a stout one is one in ten

double waist_deviations(const BodySpec& body) {
  const Prediction everybody = predict_sizes(body.sex, {});
  return (body.waist_m - everybody.mean.waist_girth) / everybody.deviation.waist_girth;
}

void round_measures(BodySpec& body) {
  for (double* measure : {&body.stature_m, &body.chest_m, &body.waist_m, &body.hip_m})
    *measure = Dice::rounded(*measure, 3);
}

// A grown-up of the survey.
BodySpec grown_up(const std::string& sample, bool stout, const Dice& dice) {
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    BodySpec asked;
    asked.sample = sample;
    asked.sample_seed = dice.whole("person " + std::to_string(attempt), 0, 999999999);
    BodySpec body = drawn_customer(asked);
    body.sample_seed = BodySpec().sample_seed;
    round_measures(body);
    if (body.stature_m >= kChildBelow_m && is_stout(body) >= stout) return body;
  }
  throw std::logic_error("drew no such person in a thousand tries");
}

// Of about nine to twelve years: girths in the parts of the stature that children have, all of them slimmer or fuller
// together. (Growth references: chest about half of the stature, waist 0.45, hip 0.52.)
BodySpec child(const std::string& sample, const Dice& dice) {
  BodySpec body;
  body.sex = sample == "man" ? "male" : "female";
  body.stature_m = body.sex == "male" ? dice.between("stature", 1.38, 1.49) : dice.between("stature", 1.30, 1.48);
  const double build = dice.between("build", 0.96, 1.12);
  body.chest_m = body.stature_m * build * dice.between("chest", 0.50, 0.52);
  body.waist_m = body.stature_m * build * dice.between("waist", 0.44, 0.46);
  body.hip_m = body.stature_m * build * dice.between("hip", 0.52, 0.54);
  round_measures(body);
  return body;
}

BodySpec person(const DrawnWishes& wishes, const std::string& sample, bool stout, const Dice& dice) {
  return wishes.child ? child(sample, dice) : grown_up(sample, stout, dice);
}

}  // namespace

bool is_stout(const BodySpec& body) { return waist_deviations(body) >= kStoutDeviations; }

BodySpec draw_wearer(const DrawnWishes& wishes, const Dice& dice) {
  const bool women_only = wishes.clothes == "skirt" || wishes.clothes == "dress";
  const std::string drawn = dice.chance("woman", 0.5) ? "woman" : "man";
  const std::string sample = wishes.people != "any" ? wishes.people : women_only ? "woman" : drawn;
  BodySpec body = person(wishes, sample, wishes.stout, dice);
  body.pose = dice.weighted("pose", {{"mannequin", 0.5}, {"a_pose", 0.25}, {"bent_arms", 0.25}});
  body.arm_angle_deg = body.pose == "a_pose" ? dice.between("arms", 32, 50, 1) : dice.between("arms", 13, 26, 1);
  return body;
}

BodySpec draw_customer(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice) {
  const std::string same = wearer.sex == "male" ? "man" : "woman", other = same == "man" ? "woman" : "man";
  BodySpec body = person(wishes, dice.chance("other sex", 0.15) ? other : same, false, dice);
  body.arm_angle_deg = dice.between("arms", 16, 30, 1);
  return body;
}

}  // namespace dressform
