#include "eval/report/rim_marks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dressform {
namespace {

std::vector<Vector3d> circle(double radius, double height) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i)
    points.emplace_back(radius * std::sin(M_PI * i / 30), height, radius * std::cos(M_PI * i / 30));
  return points;
}

TEST(RimMarks, ATubeAlongACircleIsATorus) {
  const Mesh tube = tube_along(circle(0.2, 1), 0.01);
  const Topology shape = topology(tube);
  EXPECT_TRUE(shape.closed());
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler(), 0);
  for (const auto& p : tube.vertices) EXPECT_NEAR(std::hypot(std::hypot(p.x(), p.z()) - 0.2, p.y() - 1), 0.01, 1e-3);
  EXPECT_TRUE(tube_along({Vector3d::Zero(), Vector3d::UnitX()}, 0.01).triangles.empty());
}

TEST(RimMarks, WhatNobodySawIsNamedAndDrawnApart) {
  OpenGarments opened;
  opened.garments["top"].rims = {{"neck", circle(0.1, 1.5), true}, {"hem", circle(0.3, 0.9), true}};
  EXPECT_EQ(unseen_rims_caption(opened), "");
  opened.garments["bottom"].rims = {{"waist", circle(0.2, 1), false}, {"hem", circle(0.3, 0.5), true}};
  EXPECT_EQ(unseen_rims_caption(opened), "No view saw the bottom's waist: carried on from what was seen.");
  EXPECT_TRUE(rim_marks(opened.garments.at("top")).unseen.triangles.empty());
  const RimMarks marks = rim_marks(opened.garments.at("bottom"));
  ASSERT_FALSE(marks.unseen.triangles.empty());
  for (const auto& p : marks.unseen.vertices) EXPECT_GT(p.y(), 0.99);
  for (const auto& p : marks.seen.vertices) EXPECT_LT(p.y(), 0.51);
}

}  // namespace
}  // namespace dressform
