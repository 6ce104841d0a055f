#include "pipeline/landmarks/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/testing/analytic_scene.h"
#include "pipeline/testing/figure.h"
#include "scenes/error.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

Landmarks run(const std::string& variant, const Mesh& body, const FacingClues& clues) {
  BodyModel model;
  model.body = body;
  return FindLandmarks::at(variant).run(model, clues, {}, 1);
}

Vector3d facing(double yaw) { return {std::sin(yaw), 0, std::cos(yaw)}; }
Vector3d left_of(const Vector3d& front) { return Vector3d::UnitY().cross(front); }

// A standing figure of capsules that faces +z, and what is added to it.
Mesh figure_with(bool feet, const std::function<double(const Vector3d&)>& arms) {
  const Lattice lattice = make_lattice({-0.5, 0, -0.3}, {0.5, 1.8, 0.5}, 0.03, 0.014);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Vector3d p = lattice.point(i);
    double d = std::min(capsule_distance(p, {0, 1.0, 0}, {0, 1.33, 0}, 0.14),
                        capsule_distance(p, {0, 1.4, 0}, {0, 1.7, 0}, 0.06));
    d = std::min({d, (p - Vector3d(0, 1.68, 0)).norm() - 0.10, arms(p)});
    for (const double side : {-1.0, 1.0}) {
      d = std::min(d, capsule_distance(p, {side * 0.09, 0.06, 0}, {side * 0.09, 0.95, 0}, 0.07));
      if (feet) d = std::min(d, capsule_distance(p, {side * 0.09, 0.04, 0}, {side * 0.09, 0.04, 0.14}, 0.04));
    }
    field[i] = static_cast<float>(d);
  }
  return lattice_surface(lattice, field);
}

double shoulder(const Vector3d& p, double side) {
  return capsule_distance(p, {0, 1.40, 0}, {side * 0.19, 1.40, 0}, 0.05);
}
double hanging(const Vector3d& p, double side) {
  return std::min(shoulder(p, side), capsule_distance(p, {side * 0.19, 1.40, 0}, {side * 0.36, 0.75, 0}, 0.045));
}
// Upper arm down and away, forearm folded before the belly, the hand past the body's middle.
double folded(const Vector3d& p, double side, double forearm_y) {
  const Vector3d elbow(side * 0.29, 1.08, 0.06), hand(-side * 0.10, forearm_y, 0.26);
  return std::min({shoulder(p, side), capsule_distance(p, {side * 0.19, 1.40, 0}, elbow, 0.045),
                   capsule_distance(p, elbow, hand, 0.04)});
}
double no_arms(const Vector3d&) { return 1; }

class EveryLandmarks : public testing::TestWithParam<std::string> {
 protected:
  Landmarks find(const Mesh& body, const FacingClues& clues = {}) const { return run(GetParam(), body, clues); }
};

TEST_P(EveryLandmarks, FeetTellTheFrontAndTheRigWhereThereAreNone) {
  for (const double yaw : {0.0, 1.3, 3.1, -2.0}) {
    const Landmarks own = find(make_figure({1.8, 1, 15, yaw}));
    EXPECT_EQ(own.front_from, FrontFrom::feet);
    EXPECT_GT(own.front.dot(facing(yaw)), 0.99);
    EXPECT_TRUE(own.sure);
  }
  const Mesh pillars = figure_with(false, no_arms);
  EXPECT_FALSE(find(pillars).sure);
  for (const double sign : {1.0, -1.0})
    for (const double error : {-0.7, 0.0, 0.7}) {  // legs tell the line, the rig which way along it
      const Landmarks told = find(pillars, {Vector3d(sign * facing(error)), {}});
      EXPECT_GT(told.front.z() * sign, 0.99);
      EXPECT_GT(told.left_leg->root.x() * sign, 0.05);
      EXPECT_EQ(told.front_from, FrontFrom::rig);
      EXPECT_TRUE(told.sure);
    }
}

// The sensors of a session stand round the mannequin in any order, and the mannequin may stand the other way round than
// whoever wrote the prior had it.
TEST_P(EveryLandmarks, ABodySeenFromBehindFirstKeepsItsSides) {
  analytic::AnalyticScene scene = analytic::make_scene();
  const auto expect_sides = [&](bool sure) {
    const Landmarks found = find(scene.naked.body, {front_from_rig(scene.session.prior, scene.registration), {}});
    EXPECT_GT(found.front.z(), 0.99);
    EXPECT_GT(found.left_arm->root.x(), 0.1);
    EXPECT_LT(found.right_leg->root.x(), -0.05);
    EXPECT_EQ(found.sure, sure);
    for (std::size_t i = 0; i < found.triangle_parts.size(); ++i)
      if (const BodyPart part = found.triangle_parts[i]; is_arm(part)) {
        EXPECT_EQ(side_of(part) == 0, scene.naked.body.vertices[scene.naked.body.triangles[i][0]].x() > 0);
      }
  };
  expect_sides(true);
  auto& poses = scene.registration.model_from_sensor;
  auto& prior = scene.session.prior->world_from_sensor;
  for (auto* views : {&poses, &prior}) {  // the first sensor looks at the back, and the prior says so
    std::swap(views->at("k1"), views->at("k3"));
    std::swap(views->at("k2"), views->at("k4"));
  }
  expect_sides(true);
  std::swap(prior.at("k1"), prior.at("k3"));  // it looks at the back, and the prior has it in front
  std::swap(prior.at("k2"), prior.at("k4"));
  ASSERT_LT(front_from_rig(scene.session.prior, scene.registration)->z(), -0.9);
  expect_sides(false);
}

TEST_P(EveryLandmarks, ArmsFoldedInWhateverWayKeepTheirSides) {
  const auto both = [](const auto& left, const auto& right) {
    return [=](const Vector3d& p) { return std::min(left(p), right(p)); };
  };
  const auto hangs = [](double side) { return [=](const Vector3d& p) { return hanging(p, side); }; };
  const auto folds = [](double side, double y) { return [=](const Vector3d& p) { return folded(p, side, y); }; };
  for (const Mesh& body :
       {figure_with(true, both(folds(1, 1.12), hangs(-1))), figure_with(true, both(hangs(1), folds(-1, 1.05))),
        figure_with(true, both(folds(1, 1.16), folds(-1, 1.04)))}) {
    for (const double error : {-0.5, 0.5, M_PI}) {  // the rig's prior is off, or the wrong way round
      const Landmarks found = find(body, {facing(error), {}});
      EXPECT_GT(found.front.z(), 0.99);
      EXPECT_GT(found.left_leg->root.x(), 0.05);
      for (int side = 0; side < 2; ++side) {
        const Limb* arm = found.arm(side);
        if (!arm) continue;
        EXPECT_GT(arm->root.dot(found.outwards(side)), 0.05);
      }
      for (std::size_t i = 0; i < found.triangle_parts.size(); ++i) {
        const Vector3d& p = body.vertices[body.triangles[i][0]];
        if (p.y() > 1.12 && p.y() < 1.35 && std::abs(p.x()) > 0.19) {  // upper arms
          EXPECT_NE(found.triangle_parts[i], p.x() > 0 ? BodyPart::right_arm : BodyPart::left_arm) << p.transpose();
        }
      }
    }
  }
}

TEST_P(EveryLandmarks, TheUserFacesAsTheMannequinDoes) {
  FacingClues clues;
  FigureSpec spec;
  clues.like.emplace(known_body(make_figure(spec)));
  clues.like->landmarks.sure = true;
  spec.stature_m = 1.65;
  spec.breadth = 1.15;
  for (const double yaw : {0.0, 1.3, 3.1, -2.0}) {
    spec.yaw = yaw;
    const Landmarks found = find(make_figure(spec), clues);
    EXPECT_GT(found.front.dot(facing(yaw)), std::cos(0.06)) << yaw;
    EXPECT_GT(found.left_arm->root.dot(left_of(facing(yaw))), 0.1) << yaw;
    EXPECT_EQ(found.front_from, FrontFrom::likeness);
    EXPECT_TRUE(found.has_trunk);
  }
}

TEST_P(EveryLandmarks, HeightsAreThoseOfTheFigure) {
  const Landmarks found = find(make_figure({}));
  EXPECT_NEAR(found.stature, 1.78, 0.03);
  EXPECT_NEAR(found.crotch_y, 0.86, 0.06);
  EXPECT_LT(found.hip_y, found.waist_y);
  EXPECT_LT(found.waist_y, found.chest_y);
  EXPECT_LT(found.chest_y, found.armpit_y);
  EXPECT_NEAR(found.neck_y, 1.53, 0.06);
  EXPECT_NEAR(found.axis.x(), 0, 0.01);
}

TEST_P(EveryLandmarks, UglyInput) {
  EXPECT_THROW(find({}), InputError);
  const Lattice lattice = make_lattice({-0.3, 0, -0.3}, {0.3, 0.6, 0.3}, 0.03, 0.02);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = static_cast<float>((lattice.point(i) - Vector3d(0, 0.3, 0)).norm() - 0.3);
  const Landmarks ball = find(lattice_surface(lattice, field));
  EXPECT_FALSE(ball.left_arm || ball.right_arm || ball.left_leg || ball.right_leg || ball.sure);
  EXPECT_TRUE(ball.axis.allFinite());
  EXPECT_FALSE(front_from_rig({}, {}));
  EXPECT_FALSE(front_from_rig(RigPrior{}, {}));
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryLandmarks, ::testing::ValuesIn(FindLandmarks::automatic_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace dressform
