#include "eval/report/rim_marks.h"

#include <gmock/gmock.h>
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
  Rim& neck = opened.garments["top"].rims[0];  // a quarter of it under a chin
  for (const auto& p : neck.points) neck.hidden.push_back(p.z() > 0 && std::abs(p.x()) < 0.0707);
  EXPECT_EQ(unseen_rims_caption(opened),
            "No view saw the bottom's waist, 25 % of the top's neck: carried on from what was seen.");
  opened.garments["bottom"].rims[1].name = "left_ankle";
  opened.garments["bottom"].rims[1].observed = false;
  EXPECT_THAT(unseen_rims_caption(opened), testing::HasSubstr("the bottom's left ankle"));
  opened.garments["bottom"].rims[1].observed = true;
  const RimMarks parted = rim_marks(opened.garments.at("top"));
  ASSERT_FALSE(parted.unseen.triangles.empty());
  for (const auto& t : parted.unseen.triangles) EXPECT_GT(parted.unseen.vertices[t[0]].z(), 0.05);
  const RimMarks marks = rim_marks(opened.garments.at("bottom"));
  ASSERT_FALSE(marks.unseen.triangles.empty());
  for (const auto& t : marks.unseen.triangles)
    for (int k = 0; k < 3; ++k) EXPECT_GT(marks.unseen.vertices[t[k]].y(), 0.98);
  for (const auto& t : marks.seen.triangles)
    for (int k = 0; k < 3; ++k) EXPECT_LT(marks.seen.vertices[t[k]].y(), 0.51);
}

}  // namespace
}  // namespace dressform
