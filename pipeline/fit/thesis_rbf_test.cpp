#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "pipeline/fit/fit.h"
#include "pipeline/testing/figure.h"
#include "scenes/error.h"
#include "scenes/picks.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

using testing::HasSubstr;

struct PickedTry {
  KnownBody naked, user;
  TexturedGarments clothes;
  GarmentLayouts layouts;
  Picks picks;
  Eigen::Affine3d user_from_naked = Eigen::Affine3d::Identity();  // the truth
};

// The user is the mannequin made broader and turned, so that every point has a known place on both.
const PickedTry& broader() {
  static const PickedTry made = [] {
    PickedTry result;
    result.naked = known_body(make_figure({}, 0.022));
    constexpr double kYaw = 0.4;
    result.user_from_naked = Eigen::Translation3d(0.05, 0, -0.03) * Eigen::AngleAxisd(kYaw, Vector3d::UnitY()) *
                             Eigen::Scaling(1.12, 0.96, 1.2);
    result.user.body = result.naked.body;
    for (Vector3d& v : result.user.body.vertices) v = result.user_from_naked * v;
    const Vector3d front(std::sin(kYaw), 0, std::cos(kYaw));
    result.user.landmarks = with_front(find_landmarks(result.user.body, front), front);
    result.clothes.garments["top"] = make_tube(0.175, 1.02, 1.25);
    result.clothes.garments["bottom"] = make_tube(0.18, 0.5, 1.05);
    result.layouts["top"].kind = "shirt";
    result.layouts["bottom"].kind = "skirt";
    PickedPoints control{"model", {}}, target{"user", {}};
    for (std::size_t i = 0; i < result.naked.body.vertices.size(); i += result.naked.body.vertices.size() / 200) {
      control.points.push_back(result.naked.body.vertices[i]);
      target.points.push_back(result.user.body.vertices[i]);
    }
    result.picks.points["control"].push_back(control);
    result.picks.points["target"].push_back(target);
    return result;
  }();
  return made;
}

FittedGarments run(const PickedTry& input, const Picks& picks, const FieldValues& values = {}) {
  return Fit::at("thesis_rbf").run_with_picks(input.naked, input.user, input.clothes, input.layouts, values, picks, 1);
}

TEST(ThesisRbf, OneFunctionTakesBodyAndClothesAlike) {
  const PickedTry& input = broader();
  for (const char* kernel : {"r", "r3", "thin_plate"}) {
    const FittedGarments result = run(input, input.picks, {{"kernel", std::string(kernel)}});
    EXPECT_LT(result.body_rms_m, 1e-5) << kernel;
    EXPECT_NEAR(result.control_points, 200, 10);
    EXPECT_EQ(result.foldovers, 0);
    for (const auto& [slot, garment] : result.garments) {
      const auto& before = input.clothes.garments.at(slot);
      EXPECT_EQ(garment.mesh.triangles, before.mesh.triangles);
      EXPECT_EQ(garment.corner_uv, before.corner_uv);
      for (std::size_t v = 0; v < before.mesh.vertices.size(); ++v)
        ASSERT_LT((garment.mesh.vertices[v] - input.user_from_naked * before.mesh.vertices[v]).norm(), 1e-5) << kernel;
    }
    EXPECT_EQ(result.layouts.at("top").kind, "shirt");
  }
}

// A point of the figure on one that is `b` times as broad: arms, feet and head are as thick as before.
Vector3d on_broader(const Vector3d& p, double b) {
  const double side = p.x() > 0 ? 1 : -1;
  if (std::abs(p.x()) > 0.17) return p + side * 0.20 * (b - 1) * Vector3d::UnitX();
  if (p.y() < 0.1) return p + side * 0.09 * (b - 1) * Vector3d::UnitX();
  return p.y() > 1.45 ? p : Vector3d(p.x() * b, p.y(), p.z() * b);
}

// A shape that no affine map makes, from pairs with clicks a few millimetres off.
TEST(ThesisRbf, ComesNearToAnotherShape) {
  PickedTry input = broader();
  constexpr double kBreadth = 1.2;
  input.user.body = make_figure({1.7, kBreadth, 15, 0}, 0.022);
  input.user.landmarks = with_front(find_landmarks(input.user.body, Vector3d::UnitZ()), Vector3d::UnitZ());
  for (std::size_t i = 0; i < input.picks.points["control"][0].points.size(); ++i) {
    Vector3d place = on_broader(input.picks.points["control"][0].points[i], kBreadth);
    place.y() *= 1.7 / 1.8;
    input.picks.points["target"][0].points[i] = place + 0.003 * std::sin(17.0 * i) * Vector3d(1, 0, -1);
  }
  const FittedGarments result = run(input, input.picks);
  EXPECT_LT(result.body_rms_m, 0.008);
  double radius = 0;
  for (const Vector3d& v : result.garments.at("top").mesh.vertices) radius += std::hypot(v.x(), v.z());
  EXPECT_NEAR(radius / result.garments.at("top").mesh.vertices.size(), 0.175 * kBreadth, 0.006);
}

TEST(ThesisRbf, TheNumberOfThreadsDoesNotMatter) {
  const PickedTry& input = broader();
  const auto both = to_bytes(run(input, input.picks));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(both, to_bytes(run(input, input.picks)));
}

std::string complaint(const PickedTry& input, const Picks& picks) {
  try {
    run(input, picks);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ThesisRbf, PairsThatAreNoneAreNamed) {
  const PickedTry& input = broader();
  Picks picks = input.picks;
  picks.points["target"][0].points.pop_back();
  EXPECT_THAT(complaint(input, picks), HasSubstr("picks/model/control and picks/user/target"));
  picks = input.picks;
  for (const char* name : {"control", "target"}) picks.points[name][0].points.resize(4);
  EXPECT_THAT(complaint(input, picks), HasSubstr("found 4 pairs"));
  picks = input.picks;
  picks.points["target"][0].frame = "model";
  EXPECT_THAT(complaint(input, picks), HasSubstr("expected \"user\""));
  EXPECT_THAT(complaint(input, {}), HasSubstr("found 0 pairs"));
}

// Points that came in several frames, as those of several sensors do, follow one another as the frames happen to.
TEST(ThesisRbf, PairsOfSeveralFramesOnBothSidesAreRefused) {
  const PickedTry& input = broader();
  Picks picks = input.picks;
  const auto halved = [&](const char* name) {
    auto& parts = picks.points[name];
    PickedPoints rest = parts[0];
    rest.points.erase(rest.points.begin(), rest.points.begin() + 100);
    parts[0].points.resize(100);
    parts.push_back(rest);
  };
  halved("control");
  EXPECT_EQ(to_bytes(run(input, picks)), to_bytes(run(input, input.picks)));
  halved("target");
  EXPECT_THAT(complaint(input, picks), HasSubstr("control points in 2 frames and targets in 2"));
}

}  // namespace
}  // namespace dressform
