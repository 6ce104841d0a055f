#include "pipeline/fit/limbs_apart.h"

#include <gtest/gtest.h>

#include <string>

#include "pipeline/testing/figure.h"

namespace dressform {
namespace {

double aside(const StandingBody& body, const Vector3d& point) {
  return body.landmarks.left.dot(point - body.landmarks.hips());
}

GarmentLayout of_kind(const std::string& kind) {
  GarmentLayout layout;
  layout.kind = kind;
  return layout;
}

// Two tubes round the figure's legs, so wide that each reaches 11 mm over the middle.
Mesh crossing_legs() {
  Mesh result;
  for (const double side : {-1.0, 1.0}) {
    const Mesh tube = make_tube(0.101, 0.3, 0.8).mesh;
    const int offset = static_cast<int>(result.vertices.size());
    for (const auto& v : tube.vertices) result.vertices.push_back(v + Vector3d(side * 0.09, 0, 0));
    for (const auto& t : tube.triangles) result.triangles.emplace_back(t + Vector3i::Constant(offset));
  }
  return result;
}

TEST(LimbsApart, LegsAreToldByWhereTheGarmentParts) {
  const Mesh figure = make_figure({});
  const StandingBody body(known_body(figure));
  const auto leg = limbs_of_cloth(figure, of_kind("trousers"), body).legs;  // as if it were overalls
  int wrong = 0, of_legs = 0;
  for (std::size_t v = 0; v < leg.size(); ++v) {
    const double off = aside(body, figure.vertices[v]);
    if (leg[v] != 0 && figure.vertices[v].y() > 0.95) ++wrong;
    if (leg[v] != 0 && std::abs(off) > 0.008 && leg[v] != (off > 0 ? 1 : -1)) ++wrong;  // half a cell at the fork
    const bool of_leg = figure.vertices[v].y() < 0.8 && std::abs(off) < 0.25;           // not hands
    of_legs += of_leg;
    wrong += of_leg && leg[v] == 0;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(of_legs, 1000);
}

TEST(LimbsApart, ShirtsAndSkirtsHaveNoLegs) {
  const StandingBody body(known_body(make_figure({})));
  for (const Mesh& garment : {make_tube(0.22, 0.4, 1.05).mesh, make_tube(0.175, 1.02, 1.25).mesh, Mesh{}})
    for (const char* kind : {"skirt", "shirt", "trousers"})  // of trousers as short as that, neither part
      for (const int leg : limbs_of_cloth(garment, of_kind(kind), body).legs) ASSERT_EQ(leg, 0);
  for (const int leg : limbs_of_cloth(crossing_legs(), of_kind("skirt"), body).legs) ASSERT_EQ(leg, 0);
}

TEST(LimbsApart, ClothStaysOnItsSideOfTheMiddle) {
  const StandingBody body(known_body(make_figure({})));
  const Mesh legs = crossing_legs();
  const ClothLimbs limbs = limbs_of_cloth(legs, of_kind("trousers"), body);
  const auto apart = limbs_kept_apart(legs, limbs, body, MeshQuery(body.mesh), 0.001);
  int moved = 0;
  for (std::size_t v = 0; v < apart.size(); ++v) {
    const double own = limbs.legs[v];
    ASSERT_NE(own, 0);
    ASSERT_GT(own * aside(body, apart[v]), 0.0003) << legs.vertices[v].transpose();
    ASSERT_LT((apart[v] - legs.vertices[v]).norm(), 0.015)
        << legs.vertices[v].transpose() << " to " << apart[v].transpose() << "11 mm over the middle and 1 mm off it";
    if (own * aside(body, legs.vertices[v]) > 0.003) {
      EXPECT_EQ(apart[v], legs.vertices[v]);
    }
    moved += apart[v] != legs.vertices[v];
  }
  EXPECT_GT(moved, 300);
}

}  // namespace
}  // namespace dressform
