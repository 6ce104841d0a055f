#include "pipeline/open/open.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/open/cut.h"
#include "pipeline/open/openings.h"
#include "pipeline/surface/surface.h"
#include "pipeline/testing/dressed_figure.h"

namespace dressform {
namespace {

void expect_open(const Mesh& mesh, int loops) {
  const Topology t = topology(mesh);
  EXPECT_EQ(t.loops, loops);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.non_manifold_edges, 0);
  EXPECT_EQ(t.euler(), 2 - loops);
  EXPECT_EQ(t.boundary_edges, 2 * t.vertices - t.triangles - 2 * t.euler());
}

Mesh ball(double radius) {
  return figure::surface_of(Vector3d::Constant(-radius), Vector3d::Constant(radius), 0.01,
                            [radius](const Vector3d& p) { return p.norm() - radius; });
}

Cap cap_above(const Mesh& mesh, const Vector3d& axis, double height) {
  Cap cap;
  for (const Vector3d& v : mesh.vertices) cap.beyond.push_back(v.dot(axis) - height);
  cap.pole = static_cast<int>(std::max_element(cap.beyond.begin(), cap.beyond.end()) - cap.beyond.begin());
  return cap;
}

TEST(Cut, BallWithThreeCapsOff) {
  const Mesh closed = ball(0.1);
  const std::vector<Cap> caps{cap_above(closed, Vector3d::UnitY(), 0.05), cap_above(closed, -Vector3d::UnitY(), 0.06),
                              cap_above(closed, Vector3d::UnitX(), 0.092)};
  const CutResult cut = cut_caps(closed, caps);
  expect_open(cut.mesh, 3);
  for (std::size_t i = 0; i < cut.mesh.vertices.size(); ++i) {
    const Vector3d& v = cut.mesh.vertices[i];
    if (cut.cap_of_vertex[i] == 0) {
      EXPECT_NEAR(v.y(), 0.05, 2e-4);
    }
    if (cut.cap_of_vertex[i] == 1) {
      EXPECT_NEAR(v.y(), -0.06, 2e-4);
    }
    if (cut.cap_of_vertex[i] == 2) {
      EXPECT_NEAR(v.x(), 0.092, 2e-4);
    }
  }
  const Mesh tidy = without_slivers(cut.mesh, 0.003);
  expect_open(tidy, 3);
  EXPECT_LT(tidy.vertices.size(), cut.mesh.vertices.size());
  for (const auto& loop : boundary_loops(tidy))
    for (const int v : loop) {
      const Vector3d& p = tidy.vertices[v];
      EXPECT_LT(std::min({std::abs(p.y() - 0.05), std::abs(p.y() + 0.06), std::abs(p.x() - 0.092)}), 3e-4);
    }
}

TEST(Cut, IslandsInACapGoWithIt) {
  const Mesh closed = ball(0.1);
  Cap cap = cap_above(closed, Vector3d::UnitY(), 0.0);
  for (std::size_t i = 0; i < closed.vertices.size(); ++i)
    if ((closed.vertices[i] - Vector3d(0.06, 0.08, 0)).norm() < 0.02) cap.beyond[i] = -0.01;
  expect_open(cut_caps(closed, {cap}).mesh, 1);
}

TEST(Cut, ACapThatIsNotThereGivesNothing) {
  const Mesh closed = ball(0.1);
  EXPECT_TRUE(cut_caps(closed, {cap_above(closed, Vector3d::UnitY(), 0.2)}).mesh.triangles.empty());
  EXPECT_TRUE(cut_caps(closed, {cap_above(closed, Vector3d::UnitY(), -0.2)}).mesh.triangles.empty());
}

TEST(OpeningNear, ShouldersBelongToShortSleeves) {
  const Landmarks limbs = find_landmarks(figure::body_mesh());
  std::vector<Opening> openings;
  for (const char* name : {"neck", "left_cuff", "right_cuff", "hem"}) openings.push_back({name});
  const auto near = [&](const Vector3d& point, BodyPart part) {
    return opening_near(openings, point, part, limbs)->name;
  };
  for (const double side : {1.0, -1.0}) {
    const Vector3d& root = limbs.arm(side > 0 ? 0 : 1)->root;
    const std::string cuff = side > 0 ? "left_cuff" : "right_cuff";
    EXPECT_EQ(near(root + Vector3d(side * 0.03, 0.03, 0), BodyPart::torso), cuff);
    EXPECT_EQ(near(root + Vector3d(0, -0.1, 0), side > 0 ? BodyPart::left_arm : BodyPart::right_arm), cuff);
    EXPECT_EQ(near(root + Vector3d(-side * 0.06, 0.1, 0), BodyPart::torso), "neck");
    EXPECT_EQ(near({side * 0.25, limbs.crotch_y, 0}, BodyPart::torso), "hem");
  }
}

OpenGarments run(const std::string& variant, const figure::Capture& c, const ClosedGarments& closed) {
  return Open::at(variant).run(c.session, c.calibration, c.body, c.registration, c.segmentation, closed, {}, 1);
}
ClosedGarments close(const figure::Capture& c) {
  return Surface::at(SurfaceTag::default_variant)
      .run(c.session, c.calibration, c.body, c.registration, c.filled, c.segmentation.garments, {}, 1);
}

const Rim* rim_named(const OpenGarment& garment, const std::string& name) {
  for (const Rim& rim : garment.rims)
    if (rim.name == name) return &rim;
  return nullptr;
}

double mean_y(const Rim& rim) {
  double sum = 0;
  for (const Vector3d& p : rim.points) sum += p.y() / rim.points.size();
  return sum;
}

class EveryOpening : public ::testing::TestWithParam<std::string> {};

// Variants that place no rims of their own leave out what is asked of rims; the README's row says what they do.
#define DRESSFORM_NEEDS_RIMS() \
  if (GetParam() == "density_trim") GTEST_SKIP() << "its rims are where points are thin, wherever that is"

TEST_P(EveryOpening, ShirtAndTrousersHaveTheirRims) {
  DRESSFORM_NEEDS_RIMS();
  const figure::Capture capture = figure::capture({});
  const OpenGarments open = run(GetParam(), capture, close(capture));
  ASSERT_EQ(open.garments.size(), 2u);
  const OpenGarment &top = open.garments.at("top"), &bottom = open.garments.at("bottom");
  expect_open(top.mesh, 4);
  expect_open(bottom.mesh, 3);
  for (const char* name : {"neck", "left_cuff", "right_cuff", "hem"}) ASSERT_TRUE(rim_named(top, name)) << name;
  for (const char* name : {"waist", "left_ankle", "right_ankle"}) ASSERT_TRUE(rim_named(bottom, name)) << name;
  EXPECT_NEAR(mean_y(*rim_named(top, "hem")), capture.clothes.hem_y, 0.010);
  // The figure's shoulders are nearly level there: height says little of where on them the rim lies.
  EXPECT_NEAR(mean_y(*rim_named(top, "neck")), capture.clothes.neck_y, 0.06);
  for (const double side : {1.0, -1.0}) {
    const Rim* cuff = rim_named(top, side > 0 ? "left_cuff" : "right_cuff");
    EXPECT_GT(cuff->points[0].x() * side, 0.1);  // faces +z: its left is at +x
    for (const Vector3d& p : cuff->points) EXPECT_NEAR(figure::along_arm(p, side), capture.clothes.sleeve_m, 0.025);
    const Rim* ankle = rim_named(bottom, side > 0 ? "left_ankle" : "right_ankle");
    EXPECT_NEAR(mean_y(*ankle), capture.clothes.ankle_y, 0.016);
    EXPECT_GT(ankle->points[0].x() * side, 0);
  }
  EXPECT_FALSE(rim_named(bottom, "waist")->observed);
  EXPECT_TRUE(rim_named(top, "hem")->observed);
  EXPECT_TRUE(open.failed.empty());
  EXPECT_EQ(top.layout.worn, Worn::over);
  EXPECT_EQ(bottom.layout.worn, Worn::under);
  const double shoulder = capture.body.landmarks.left_arm->along(figure::shoulder(1));
  EXPECT_NEAR(top.layout.arms[0].end_m, shoulder + capture.clothes.sleeve_m, 0.05);  // bins of 40 mm
}

TEST_P(EveryOpening, WhatCannotBeOpenedSaysWhy) {
  const figure::Capture capture = figure::capture({}, 0, 0.25);
  ClosedGarments closed;
  closed.garments["top"].mesh = ball(0.1);
  closed.garments["top"].layout.kind = "shirt";
  const OpenGarments open = run(GetParam(), capture, closed);
  EXPECT_TRUE(open.garments.empty());
  EXPECT_FALSE(open.failed.at("top").empty());
}

TEST_P(EveryOpening, SkirtHasTwoRims) {
  DRESSFORM_NEEDS_RIMS();
  figure::Clothes clothes;
  clothes.skirt = true;
  clothes.ankle_y = 0.5;
  figure::Capture capture = figure::capture(clothes);
  for (const char* kind : {"skirt", "trousers"}) {  // folds may pass for legs before there is a surface
    capture.segmentation.garments["bottom"].kind = kind;
    const ClosedGarments closed = close(capture);
    EXPECT_EQ(closed.garments.at("bottom").layout.kind, "skirt");
    const OpenGarments open = run(GetParam(), capture, closed);
    ASSERT_TRUE(open.garments.count("bottom"));
    expect_open(open.garments.at("bottom").mesh, 2);
    EXPECT_NEAR(mean_y(*rim_named(open.garments.at("bottom"), "hem")), 0.5, 0.012);
  }
}

TEST_P(EveryOpening, TuckedShirtShowsTheWaist) {
  DRESSFORM_NEEDS_RIMS();
  figure::Clothes clothes;
  clothes.bottom_ease_m = 0.035;
  clothes.waist_y = 1.05;
  const figure::Capture capture = figure::capture(clothes);
  const OpenGarments open = run(GetParam(), capture, close(capture));
  ASSERT_EQ(open.garments.size(), 2u);
  const Rim* waist = rim_named(open.garments.at("bottom"), "waist");
  ASSERT_TRUE(waist);
  EXPECT_TRUE(waist->observed);
  EXPECT_NEAR(mean_y(*waist), clothes.waist_y, 0.010);
  EXPECT_FALSE(rim_named(open.garments.at("top"), "hem")->observed);
}

// A long sleeve whose surface is one with the trunk's from the armpit to below the hem.
TEST_P(EveryOpening, SleeveThatTouchesTheTrunkBelowTheHemStaysOn) {
  DRESSFORM_NEEDS_RIMS();
  figure::Clothes clothes;
  clothes.sleeve_m = 0.50;
  clothes.hem_y = 1.02;
  const figure::Capture capture = figure::capture(clothes);
  ClosedGarments closed = close(capture);
  figure::Clothes longer = clothes;
  longer.sleeve_m += 0.04;
  longer.hem_y -= 0.04;
  longer.neck_y += 0.04;
  closed.garments["top"].mesh = figure::surface_of({-0.5, 0.7, -0.25}, {0.5, 1.6, 0.25}, 0.012, [&](const Vector3d& p) {
    const Vector3d to_bridge = (p - Vector3d(0.19, 1.19, 0)).cwiseAbs() - Vector3d(0.09, 0.205, 0.03);
    return std::min(figure::shirt(p, longer), to_bridge.maxCoeff());
  });
  const OpenGarments open = run(GetParam(), capture, closed);
  ASSERT_TRUE(open.garments.count("top"));
  expect_open(open.garments.at("top").mesh, 4);
  for (const double side : {1.0, -1.0}) {
    const Rim* cuff = rim_named(open.garments.at("top"), side > 0 ? "left_cuff" : "right_cuff");
    ASSERT_TRUE(cuff);
    for (const Vector3d& p : cuff->points) EXPECT_NEAR(figure::along_arm(p, side), clothes.sleeve_m, 0.03);
  }
}

void expect_ankles(const OpenGarments& open, double height, double tolerance) {
  ASSERT_TRUE(open.garments.count("bottom"));
  for (const char* name : {"left_ankle", "right_ankle"}) {
    const Rim* ankle = rim_named(open.garments.at("bottom"), name);
    ASSERT_TRUE(ankle) << name;
    for (const Vector3d& p : ankle->points) EXPECT_NEAR(p.y(), height, tolerance) << name;
  }
}

// Legs that run on below the ankle and keep apart, as closed surfaces do; points end a pixel or two before the cloth
// does.
ClosedGarments long_legs(const figure::Clothes& clothes) {
  figure::Clothes longer = clothes;
  longer.ankle_y -= 0.05;
  ClosedGarments closed;
  ClosedGarment& bottom = closed.garments["bottom"];
  bottom.layout.kind = "trousers";
  bottom.mesh = figure::surface_of({-0.3, 0.1, -0.25}, {0.3, 1.15, 0.25}, 0.012, [&](const Vector3d& p) {
    return std::max(figure::bottom(p, longer), std::min(0.009 - std::abs(p.x()), 0.85 - p.y()));
  });
  for (const Vector3d& v : bottom.mesh.vertices)
    if (v.y() > clothes.ankle_y + 0.015) bottom.support.points.push_back(v);
  return closed;
}

TEST_P(EveryOpening, DepthShowsWhereLegsEnd) {
  DRESSFORM_NEEDS_RIMS();
  figure::Clothes clothes;
  clothes.bottom_ease_m = 0.025;
  clothes.ankle_y = 0.30;
  const figure::Capture capture = figure::capture(clothes, 0.001);
  const ClosedGarments closed = long_legs(clothes);
  figure::Capture below = capture;  // the colour image ends 0.45 m above the floor
  for (auto& [name, sensor] : below.calibration.sensors) {
    sensor.color->height = 215;
    below.segmentation.labels[name] = below.segmentation.labels[name].rowRange(0, 215).clone();
  }
  expect_ankles(run(GetParam(), below, closed), clothes.ankle_y, 0.010);
  figure::Capture shadow = capture;  // skin in the shade of the hem taken for cloth, 40 mm down
  cv::Mat& labels = shadow.segmentation.labels["k1"];
  for (int x = 0; x < labels.cols; ++x)
    for (int y = labels.rows - 1; y > 5; --y)
      if (labels.at<uchar>(y, x) == 1 && labels.at<uchar>(y - 5, x) == 3) labels.at<uchar>(y, x) = 3;
  expect_ankles(run(GetParam(), shadow, closed), clothes.ankle_y, 0.010);
}

TEST_P(EveryOpening, NothingToOpenIsNothing) {
  const figure::Capture capture = figure::capture({}, 0, 0.25);
  EXPECT_TRUE(run(GetParam(), capture, {}).garments.empty());
  ClosedGarments empty;
  empty.garments["top"] = {};
  const OpenGarments none = run(GetParam(), capture, empty);
  EXPECT_TRUE(none.garments.empty());
  EXPECT_EQ(none.failed.at("top"), "there is no closed surface");
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryOpening, ::testing::ValuesIn(Open::automatic_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace dressform
