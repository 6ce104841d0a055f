#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "scenes/error.h"
#include "synthetic/body/anthropometry.h"
#include "synthetic/body/body.h"
#include "synthetic/body/body_measure.h"
#include "synthetic/body/figure_sizes.h"
#include "synthetic/geometry/self_intersection.h"

namespace dressform {
namespace {

BodySpec customer(int number) {
  BodySpec spec;
  spec.sample = number % 2 == 0 ? "man" : "woman";
  spec.sample_seed = number;
  return spec;
}

// What is measured on the mesh, and the heights that the body gives.
BodySizes measured(const Body& body) {
  BodySizes sizes = measure_sizes(body.landmarks, body.joints, mesh_slicer(body.mesh));
  const BodyLandmarks slices = measure_body(body.mesh, "customer").landmarks;
  sizes.stature = slices.stature;
  sizes.crotch_height = slices.crotch;
  sizes.axilla_height = slices.armpit;
  sizes.cervicale_height = body.landmarks.neck;
  sizes.acromion_height = body.landmarks.shoulder;
  sizes.chest_height = body.landmarks.chest;
  sizes.waist_height = body.landmarks.waist;
  sizes.hip_height = body.landmarks.hip;
  sizes.knee_height = body.landmarks.knee;
  sizes.ankle_height = body.landmarks.ankle;
  const Vector3d shoulder = body.joints.at("ShoulderLeft"), upper_arm = body.joints.at("ElbowLeft") - shoulder;
  // From the acromion, above the joint.
  sizes.upper_arm_length =
      upper_arm.norm() - (body.landmarks.shoulder - shoulder.y()) * upper_arm.y() / upper_arm.norm();
  sizes.forearm_length = (body.joints.at("WristLeft") - body.joints.at("ElbowLeft")).norm();
  return sizes;
}

// Deviations of each measure from what the statistics predict from stature and the three girths, over many customers.
struct Spread {
  double sum = 0, worst = 0;
  int count = 0, outside = 0;
};

class Customers {
 public:
  void check(int number) {
    SCOPED_TRACE(number);
    const BodySpec spec = drawn_customer(customer(number));
    const Body body = make_body(customer(number));
    const Topology shape = topology(body.mesh);
    EXPECT_TRUE(shape.closed());
    EXPECT_EQ(shape.components, 1);
    EXPECT_EQ(shape.euler(), 2);
    EXPECT_EQ(self_intersections(body.mesh), 0);
    EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.chest), spec.chest_m, 1e-3);
    EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.waist), spec.waist_m, 1e-3);
    EXPECT_NEAR(tape_girth(body.mesh, body.landmarks.hip), spec.hip_m, 1e-3);
    compare(spec, measured(body));
  }

  void print() const {
    for (const auto& [name, spread] : spreads_)
      std::printf("%-22s mean %+5.2f sd, worst %+5.2f, outside %d of %d\n", name.c_str(), spread.sum / spread.count,
                  spread.worst, spread.outside, spread.count);
  }

 private:
  void compare(const BodySpec& spec, const BodySizes& found) {
    const Prediction expected = predict_sizes(spec.sex, known_measures(spec));
    // Bones, hands and feet are made to measure, not found on the surface.
    static const std::set<std::string> not_on_surface{
        "suprasternale_height", "trochanterion_height", "biacromial_breadth", "head_top_above_ear",
        "hand_length",          "hand_breadth",         "foot_length",        "foot_breadth"};
    for (const auto& [name, member] : kSurveyMeasures) {
      const double deviation = expected.deviation.*member;
      if (deviation == 0 || not_on_surface.count(name) > 0) continue;
      const double off = (found.*member - expected.mean.*member) / deviation;
      Spread& spread = spreads_[(spec.sex == "male" ? "men " : "women ") + std::string(name)];
      spread.sum += off;
      ++spread.count;
      spread.outside += std::abs(off) > 1;
      if (std::abs(off) > std::abs(spread.worst)) spread.worst = off;
      EXPECT_LE(std::abs(off), 1) << name << " is " << found.*member << " m, expected " << expected.mean.*member
                                  << " +- " << deviation;
    }
  }

  std::map<std::string, Spread> spreads_;
};

TEST(Prediction, KnowsWhatItIsToldAndTheSurveysMeans) {
  const Prediction nothing = predict_sizes("male", {});
  EXPECT_NEAR(nothing.mean.stature, 1.75621, 1e-9);
  EXPECT_NEAR(nothing.deviation.waist_girth, 0.11171, 1e-9);
  const Prediction tall = predict_sizes("male", {{&BodySizes::stature, 1.90}});
  EXPECT_DOUBLE_EQ(tall.mean.stature, 1.90);
  EXPECT_DOUBLE_EQ(tall.deviation.stature, 0);
  // One known measure: mean + r * (sd / sd) * excess, sd * sqrt(1 - r^2), with r = 0.984 for the height of the neck.
  EXPECT_NEAR(tall.mean.cervicale_height, 1.51730 + 0.984 * 0.06328 / 0.06855 * (1.90 - 1.75621), 1e-9);
  EXPECT_NEAR(tall.deviation.cervicale_height, 0.06328 * std::sqrt(1 - 0.984 * 0.984), 1e-9);
  EXPECT_THROW(predict_sizes("child", {}), InputError);
}

TEST(Customer, AreDrawnFromTheSurvey) {
  for (const char* sample : {"man", "woman"}) {
    constexpr int kCount = 4000;
    double sum = 0, sum_squares = 0, with_hip = 0, hip = 0, hip_squares = 0;
    for (int i = 0; i < kCount; ++i) {
      BodySpec spec;
      spec.sample = sample;
      spec.sample_seed = i;
      const BodySpec drawn = drawn_customer(spec);
      sum += drawn.waist_m / kCount;
      sum_squares += drawn.waist_m * drawn.waist_m / kCount;
      hip += drawn.hip_m / kCount;
      hip_squares += drawn.hip_m * drawn.hip_m / kCount;
      with_hip += drawn.waist_m * drawn.hip_m / kCount;
    }
    const bool man = std::string(sample) == "man";
    const double deviation = std::sqrt(sum_squares - sum * sum), hip_deviation = std::sqrt(hip_squares - hip * hip);
    EXPECT_NEAR(sum, man ? 0.94058 : 0.86091, 0.006);
    EXPECT_NEAR(deviation, man ? 0.11171 : 0.09993, 0.005);
    EXPECT_GT((with_hip - sum * hip) / (deviation * hip_deviation), 0.75);
  }
  const BodySpec a = drawn_customer(customer(3)), b = drawn_customer(customer(3)), c = drawn_customer(customer(5));
  EXPECT_EQ(a.stature_m, b.stature_m);
  EXPECT_NE(a.stature_m, c.stature_m);
  EXPECT_EQ(a.sex, "female");
  EXPECT_EQ(drawn_customer({}).stature_m, BodySpec().stature_m);
  BodySpec child;
  child.sample = "child";
  EXPECT_THROW(drawn_customer(child), InputError);
}

TEST(Customer, TwelveAreBuiltAsPeopleAre) {
  Customers customers;
  for (int number = 0; number < 12; ++number) customers.check(number);
}

// The long run: synthetic_test --gtest_also_run_disabled_tests --gtest_filter=Customer.DISABLED_*
TEST(Customer, DISABLED_TwoHundredAreBuiltAsPeopleAre) {
  Customers customers;
  for (int number = 0; number < 200; ++number) customers.check(number);
  customers.print();
}

}  // namespace
}  // namespace dressform
