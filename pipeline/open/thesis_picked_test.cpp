#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/open/open.h"
#include "pipeline/open/picked_loop.h"
#include "pipeline/open/stitch.h"
#include "pipeline/testing/dressed_figure.h"
#include "scenes/picks.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

using testing::HasSubstr;

constexpr int kAround = 40;

// Points of a circle from one angle to another (the last one left out), about `axis`.
std::vector<Vector3d> arc(const Vector3d& centre, const Vector3d& axis, double radius, int count, double from = 0,
                          double to = 2 * M_PI) {
  const Vector3d right = axis.unitOrthogonal(), ahead = axis.cross(right);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double angle = from + (to - from) * i / count;
    points.push_back(centre + radius * (std::cos(angle) * right + std::sin(angle) * ahead));
  }
  return points;
}

double area_m2(const Mesh& mesh) {
  double sum = 0;
  for (const double area : triangle_areas_m2(mesh)) sum += area;
  return sum;
}

TEST(PickedLoop, PartsOfTwoSensorsBecomeOneCircleInOrder) {
  const Vector3d centre(0.1, 1, 0.2), axis = Vector3d(0.2, 1, -0.1).normalized();
  constexpr double kRadius_m = 0.06;
  // Two sensors see 150 degrees each, 30 of them both, the second one the other way round; 90 degrees nobody sees.
  const double degree = M_PI / 180;
  auto second = arc(centre, axis, kRadius_m, 25, 120 * degree, 270 * degree);
  std::reverse(second.begin(), second.end());
  const auto loop = picked_loop(
      {{"model", arc(centre, axis, kRadius_m, 25, 0, 150 * degree)}, {"model", second}, {"user", {Vector3d(9, 9, 9)}}});
  EXPECT_NEAR(loop.size(), 60, 2);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    EXPECT_NEAR((loop[i] - centre).norm(), kRadius_m, 1e-4);
    EXPECT_NEAR((loop[i] - loop[(i + 1) % loop.size()]).norm(), 2 * M_PI * kRadius_m / 60, 0.0025) << i;
  }
  EXPECT_NEAR(enclosed_area_m2(loop), M_PI * kRadius_m * kRadius_m, 1e-4);
}

TEST(PickedLoop, OnePartKeepsItsOrderAndLosesItsRepeats) {
  const std::vector<Vector3d> zigzag{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0.2, 0, 1}, {0, 0, 0}};
  EXPECT_EQ(picked_loop({{"model", zigzag}}), (std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0.2, 0, 1}}));
  EXPECT_TRUE(picked_loop({{"user", zigzag}}).empty());
}

// A flat ring between a boundary of many vertices and fewer picked points about it.
TEST(Stitch, MakesARingOfOneTriangleForEachPointAndEdge) {
  for (const bool reversed : {false, true})
    for (const int picks : {12, 17, 200}) {
      Mesh disc;
      disc.vertices = arc({0, 0, 0}, Vector3d::UnitY(), 0.1, 60);
      disc.vertices.push_back({0, 0, 0});
      for (int i = 0; i < 60; ++i) disc.triangles.push_back({i, (i + 1) % 60, 60});
      auto around = arc({0, 0, 0}, Vector3d::UnitY(), 0.13, picks, 0.3, 0.3 + 2 * M_PI);
      if (reversed) std::reverse(around.begin(), around.end());
      const double sign = disc.vertices[0].cross(disc.vertices[1]).y();
      stitch(disc, boundary_loops(disc).at(0), around);
      const Topology t = topology(disc);
      EXPECT_EQ(t.loops, 1);
      EXPECT_EQ(t.boundary_edges, picks);
      EXPECT_EQ(t.triangles, 60 + 60 + picks);
      EXPECT_EQ(t.euler(), 1);
      EXPECT_NEAR(area_m2(disc), enclosed_area_m2(around), 1e-9);  // nothing lies on anything
      for (const Vector3i& c : disc.triangles)
        EXPECT_GT(
            sign * (disc.vertices[c[1]] - disc.vertices[c[0]]).cross(disc.vertices[c[2]] - disc.vertices[c[0]]).y(), 0);
    }
}

// A closed shirt that runs on beyond its ends, and circles picked where they are.
struct Shirt {
  figure::Clothes clothes;
  KnownBody body = known_body(figure::body_mesh());
  ClosedGarments closed;
  Picks picks;

  void pick(const std::string& name, std::vector<Vector3d> points) {
    picks.points["rim_top_" + name].push_back({"model", std::move(points)});
  }
};
const Shirt& shirt() {
  static const Shirt made = [] {
    Shirt s;
    figure::Clothes longer = s.clothes;
    longer.sleeve_m += 0.04;
    longer.hem_y -= 0.04;
    longer.neck_y += 0.04;
    ClosedGarment& top = s.closed.garments["top"];
    top.layout.kind = "shirt";
    top.mesh = figure::surface_of({-0.5, 0.8, -0.25}, {0.5, 1.6, 0.25}, 0.012,
                                  [&](const Vector3d& p) { return figure::shirt(p, longer); });
    for (const Vector3d& v : top.mesh.vertices)
      if (figure::shirt(v, s.clothes) < 0.003) top.support.points.push_back(v);
    s.pick("neck", arc({0, s.clothes.neck_y, 0}, Vector3d::UnitY(), 0.1095, kAround));
    s.pick("hem", arc({0, s.clothes.hem_y, 0}, -Vector3d::UnitY(), 0.169, kAround));
    for (const double side : {1.0, -1.0}) {
      const Vector3d along = (figure::hand(side) - figure::shoulder(side)).normalized();
      s.pick(side > 0 ? "left_cuff" : "right_cuff",
             arc(figure::shoulder(side) + s.clothes.sleeve_m * along, along, 0.065, kAround));
    }
    return s;
  }();
  return made;
}

OpenGarments run(const Shirt& s, const Picks& picks, const FieldValues& values = {}) {
  return Open::at("thesis_picked").run_with_picks({}, {}, s.body, {}, {}, s.closed, values, picks, 1);
}

void expect_open_at(const Shirt& s, const OpenGarments& open, int boundary_edges) {
  ASSERT_TRUE(open.garments.count("top")) << open.failed.at("top");
  const OpenGarment& top = open.garments.at("top");
  const Topology t = topology(top.mesh);
  EXPECT_EQ(t.vertices, static_cast<int>(top.mesh.vertices.size()));
  EXPECT_EQ(t.loops, 4);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.non_manifold_edges, 0);
  EXPECT_EQ(t.euler(), -2);
  EXPECT_EQ(t.boundary_edges, 2 * t.vertices - t.triangles - 2 * t.euler());
  EXPECT_EQ(t.boundary_edges, boundary_edges);
  EXPECT_EQ(top.rims.size(), 4u);
  for (const Vector3d& v : top.mesh.vertices) {
    const double side = v.x() > 0 ? 1 : -1;
    EXPECT_LT(v.y(), s.clothes.neck_y + 0.012);
    EXPECT_GT(v.y(), s.clothes.hem_y - 0.012);
    if (std::abs(v.x()) > 0.2) {
      EXPECT_LT(figure::along_arm(v, side), s.clothes.sleeve_m + 0.012);
    }
  }
}

TEST(ThesisPicked, BoundariesAreThePickedPoints) {
  const Shirt& s = shirt();
  const OpenGarments open = run(s, s.picks);
  expect_open_at(s, open, 4 * kAround);
  for (const Rim& rim : open.garments.at("top").rims) {
    EXPECT_TRUE(rim.observed);
    EXPECT_EQ(rim.points, s.picks.points.at("rim_top_" + rim.name)[0].points);
  }
}

TEST(ThesisPicked, ClicksThatAreOffStillPartTheSurface) {
  const Shirt& s = shirt();
  Picks shaken = s.picks;
  for (auto& [name, parts] : shaken.points)
    for (std::size_t i = 0; i < parts[0].points.size(); ++i)
      parts[0].points[i] += 0.006 * Vector3d(std::sin(7.0 * i), std::sin(5.0 * i + 1), std::sin(11.0 * i + 2));
  expect_open_at(s, run(s, shaken), 4 * kAround);
}

TEST(ThesisPicked, FewPointsAreEnoughAndOrderMayTurn) {
  const Shirt& s = shirt();
  Picks few = s.picks;
  for (auto& [name, parts] : few.points) {
    std::vector<Vector3d> some;
    for (std::size_t i = 0; i < parts[0].points.size(); i += 4) some.push_back(parts[0].points[i]);
    std::reverse(some.begin(), some.end());
    parts[0].points = some;
  }
  expect_open_at(s, run(s, few), kAround);
}

TEST(ThesisPicked, WhatIsMissingOrElsewhereIsSaid) {
  const Shirt& s = shirt();
  Picks picks = s.picks;
  picks.points.erase("rim_top_left_cuff");
  EXPECT_THAT(run(s, picks).failed.at("top"), HasSubstr("picks/model/rim_top_left_cuff"));
  picks = s.picks;
  picks.points["rim_top_hem"][0].points.resize(2);
  EXPECT_THAT(run(s, picks).failed.at("top"), HasSubstr("picks/model/rim_top_hem"));
  picks = s.picks;
  for (Vector3d& p : picks.points["rim_top_neck"][0].points) p.y() += 0.3;
  EXPECT_THAT(run(s, picks).failed.at("top"), HasSubstr("neck lies"));
  picks = s.picks;
  auto& hem = picks.points["rim_top_hem"][0].points;
  for (std::size_t i = 0; i < hem.size(); ++i) hem[i] = {0, 1.1 + 0.01 * std::min(i, hem.size() - i), 0.17};  // a line
  EXPECT_THAT(run(s, picks).failed.at("top"), HasSubstr("hem go round nothing"));
  picks = s.picks;
  picks.points["rim_top_left_cuff"] = picks.points["rim_top_right_cuff"];
  EXPECT_THAT(run(s, picks).failed.at("top"), HasSubstr("run into one another"));
  Shirt nothing = s;
  nothing.closed.garments["top"].mesh = {};
  EXPECT_EQ(run(nothing, s.picks).failed.at("top"), "there is no closed surface");
  nothing.closed.garments.clear();
  EXPECT_TRUE(run(nothing, s.picks).garments.empty());
  nothing.body = {};
  EXPECT_THROW(run(nothing, s.picks), InputError);
}

// Two tubes or one: whoever picks says so.
TEST(ThesisPicked, PickedHemMakesASkirt) {
  Shirt s = shirt();
  s.closed.garments.clear();
  ClosedGarment& bottom = s.closed.garments["bottom"];
  bottom.layout.kind = "trousers";
  bottom.layout.worn = Worn::under;
  bottom.mesh = figure::surface_of({-0.25, 0.4, -0.25}, {0.25, 1.2, 0.25}, 0.015, [](const Vector3d& p) {
    return std::max({std::hypot(p.x(), p.z()) - 0.2, p.y() - 1.1, 0.5 - p.y()});
  });
  bottom.support.points = arc({0, 0.8, 0}, Vector3d::UnitY(), 0.2, 200);
  Picks picks;
  picks.points["rim_bottom_waist"].push_back({"model", arc({0, 1.05, 0}, Vector3d::UnitY(), 0.2, 50)});
  picks.points["rim_bottom_hem"].push_back({"model", arc({0, 0.55, 0}, Vector3d::UnitY(), 0.2, 60)});
  const OpenGarments open = run(s, picks);
  ASSERT_TRUE(open.garments.count("bottom")) << open.failed.at("bottom");
  const OpenGarment& skirt = open.garments.at("bottom");
  EXPECT_EQ(skirt.layout.kind, "skirt");
  EXPECT_EQ(topology(skirt.mesh).boundary_edges, 110);
  EXPECT_EQ(topology(skirt.mesh).euler(), 0);
  EXPECT_EQ(skirt.rims[0].name, "waist");
  EXPECT_FALSE(skirt.rims[0].observed);
  EXPECT_TRUE(skirt.rims[1].observed);
}

}  // namespace
}  // namespace dressform
