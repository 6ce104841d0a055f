#include "pipeline/open/open.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/open/cut.h"
#include "pipeline/open/depth_edges.h"
#include "pipeline/open/rim_fit.h"
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

TEST(RimFit, SlantedRimWithOutliersAndAGap) {
  std::vector<RimSample> samples;
  const auto truth = [](double angle) { return 0.2 + 0.02 * std::cos(angle) + 0.01 * std::sin(2 * angle); };
  for (int i = 0; i < 600; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / 600.0;
    if (angle > 1.0 && angle < 1.8) continue;  // hidden
    const auto noise = normal4(5, 1, i);
    samples.push_back({angle, truth(angle) + 0.002 * noise[0], 1});
    if (i % 5 == 0) samples.push_back({angle, 0.05 + 0.01 * noise[1], 1});  // edges of something else
    if (angle < -2.9) samples.push_back({angle, 0.06, 1});
  }
  const RimCurve curve = fit_rim(samples, {});
  for (double angle = -3; angle < 3.1; angle += 0.05)
    EXPECT_NEAR(curve.at(angle), truth(angle), angle > 0.9 && angle < 1.9 ? 0.006 : 0.003) << angle;
  EXPECT_NEAR(curve.coverage, 1 - 0.8 / (2 * M_PI), 0.06);
  EXPECT_LT(curve.residual_rms_m, 0.004);
}

TEST(RimFit, WhatIsHiddenGoesOnAsAFlatCut) {
  std::vector<RimSample> samples;
  const auto truth = [](double angle) { return 0.3 + 0.015 * std::cos(angle) - 0.01 * std::sin(angle); };
  for (int i = 0; i < 600; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / 600.0;
    const auto noise = normal4(6, 1, i);
    if (std::abs(angle) < 1.2 || std::abs(angle) > 2.6) samples.push_back({angle, truth(angle) + 0.002 * noise[0], 1});
    // The outline of the limb: many samples at all places along it, next to what is hidden.
    if (angle > 1.2 && angle < 1.5)
      for (int k = 0; k < 20; ++k) samples.push_back({angle, 0.01 * k + 0.05, 1});
  }
  const FlatCut flat = fit_flat_cut(samples, 0.008);
  EXPECT_NEAR(flat.middle, 0.3, 0.002);
  EXPECT_NEAR(flat.tilt_cos, 0.015, 0.002);
  EXPECT_NEAR(flat.tilt_sin, -0.01, 0.003);
  const RimCurve curve = fit_rim(samples, {});
  for (double angle = -3; angle < 3.1; angle += 0.05) EXPECT_NEAR(curve.at(angle), truth(angle), 0.006) << angle;
}

TEST(RimFit, DeepVNeckIsFollowed) {
  std::vector<RimSample> samples;
  const auto truth = [](double angle) { return -0.09 - 0.08 * std::max(0.0, 1 - std::abs(angle) / 0.7); };
  for (int i = 0; i < 500; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / 500.0;
    samples.push_back({angle, truth(angle) + 0.002 * normal4(7, 1, i)[0], 1});
  }
  const RimCurve curve = fit_rim(samples, {});
  for (double angle = -3; angle < 3.1; angle += 0.05)
    EXPECT_NEAR(curve.at(angle), truth(angle), std::abs(angle) < 0.1 ? 0.012 : 0.005) << angle;
}

// Where a print or a shadow draws the mask's edge into the cloth, and nothing shows the true edge.
TEST(RimFit, StraysThatReachALittleWayRoundMakeNoDent) {
  for (const double depth : {0.035, 0.045}) {
    std::vector<RimSample> samples;
    const auto truth = [](double angle) { return -0.1 + 0.02 * std::cos(angle) - 0.008 * std::cos(2 * angle); };
    for (int i = 0; i < 500; ++i) {
      const double angle = -M_PI + 2 * M_PI * i / 500.0, off = std::abs(angle + 1.4);
      const double stray = off < 0.2 ? depth * (1 - off / 0.3) : 0;
      samples.push_back({angle, truth(angle) - stray + 0.001 * normal4(8, 1, i)[0], 0.5});
    }
    const RimCurve curve = fit_rim(samples, {});
    for (double angle = -3; angle < 3.1; angle += 0.05) EXPECT_NEAR(curve.at(angle), truth(angle), 0.010) << angle;
  }
}

TEST(RimFit, DepthOfTheSameViewOverrulesMaskEdges) {
  const std::vector<RimSample> mask{{0.00, 0.30, 1, 0}, {0.02, 0.28, 1, 0}, {0.02, 0.30, 1, 1}, {1.00, 0.30, 1, 0}};
  const std::vector<RimSample> depth{{0.03, 0.275, 1, 0}, {0.05, 0.270, 1, 0}};
  const auto both = reconciled(mask, depth, 0.010);
  ASSERT_EQ(both.size(), 5u);  // the first of the mask's is gone: the third is another view's, the fourth elsewhere
  EXPECT_EQ(both[0].along, 0.28);
  EXPECT_EQ(both[1].view, 1);
  EXPECT_EQ(both[2].angle, 1.00);
}

TEST(RimFit, NothingSeenIsNoCurve) {
  EXPECT_TRUE(fit_rim({}, {}).knots.empty());
  EXPECT_EQ(fit_rim({}, {}).coverage, 0);
}

TEST(ClosedBottomKind, IsWhatTheSurfaceIs) {
  const BodyLimbs limbs = find_limbs(figure::body_mesh());
  figure::Clothes clothes;
  const auto kind = [&] {
    const Mesh closed = figure::surface_of({-0.4, 0.1, -0.4}, {0.4, 1.15, 0.4}, 0.015,
                                           [&](const Vector3d& p) { return figure::bottom(p, clothes); });
    return closed_bottom_kind(closed, limbs, "unknown");
  };
  EXPECT_EQ(kind(), "trousers");
  clothes.skirt = true;
  EXPECT_EQ(kind(), "skirt");
  clothes.ankle_y = limbs.crotch_y;
  EXPECT_EQ(kind(), "unknown");
}

TEST(OpeningNear, ShouldersBelongToShortSleeves) {
  const BodyLimbs limbs = find_limbs(figure::body_mesh());
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
  return Open::at(variant).run(c.session, c.calibration, c.naked, c.registration, c.segmentation, closed, {}, 1);
}
ClosedGarments close(const figure::Capture& c) {
  return Surface::at(SurfaceTag::default_variant)
      .run(c.session, c.calibration, c.naked, c.registration, c.filled, {}, 1);
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

TEST_P(EveryOpening, ShirtAndTrousersHaveTheirRims) {
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
}

TEST_P(EveryOpening, SkirtHasTwoRims) {
  figure::Clothes clothes;
  clothes.skirt = true;
  clothes.ankle_y = 0.5;
  figure::Capture capture = figure::capture(clothes);
  const ClosedGarments closed = close(capture);
  for (const char* kind : {"skirt", "trousers"}) {  // folds may pass for legs before there is a surface
    capture.segmentation.kinds["bottom"] = kind;
    const OpenGarments open = run(GetParam(), capture, closed);
    ASSERT_TRUE(open.garments.count("bottom"));
    expect_open(open.garments.at("bottom").mesh, 2);
    EXPECT_NEAR(mean_y(*rim_named(open.garments.at("bottom"), "hem")), 0.5, 0.012);
  }
}

TEST_P(EveryOpening, TuckedShirtShowsTheWaist) {
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
  bottom.mesh = figure::surface_of({-0.3, 0.1, -0.25}, {0.3, 1.15, 0.25}, 0.012, [&](const Vector3d& p) {
    return std::max(figure::bottom(p, longer), std::min(0.009 - std::abs(p.x()), 0.85 - p.y()));
  });
  for (const Vector3d& v : bottom.mesh.vertices)
    if (v.y() > clothes.ankle_y + 0.015) bottom.support.points.push_back(v);
  return closed;
}

TEST_P(EveryOpening, DepthShowsWhereLegsEnd) {
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
  EXPECT_TRUE(run(GetParam(), capture, empty).garments.empty());
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryOpening, ::testing::ValuesIn(Open::names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace dressform
