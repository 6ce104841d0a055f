#include "synthetic/garments/underarm.h"

#include <gtest/gtest.h>

#include "synthetic/garments/garment_checks.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/geometry/contour.h"

namespace dressform {
namespace {

// A trunk 0.30 m across and 0.12 m beside it an arm of 0.10 m, which hangs from a height of 1.5 m.
Tube round(const Tube::Frame& frame, double length, double radius) {
  const LimbSection section{0, {0, 0}, radius, radius, radius, radius, 2};
  std::vector<LimbSection> sections{section, section};
  sections[1].s = length;
  return Tube::from_sections(frame, sections);
}
Tube trunk() { return round({}, 1.6, 0.15); }
Tube arm() { return round({{0.32, 1.5, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 0.6, 0.05); }

TEST(Underarm, EachLayerEndsAtItsSideOfTheGap) {
  const Underarm gap(trunk(), arm(), 1, 0.5);
  ASSERT_TRUE(gap.start_y());
  const Field everywhere = [](const Vector3d&) { return -0.05; };
  const Field cloth = gap.trunk_side(everywhere), sleeve = gap.arm_side(everywhere);
  // The middle between the two is at x = 0.21; 8 mm to each side of it are free.
  const double y = *gap.start_y() - 0.2;
  EXPECT_LT(cloth({0.20, y, 0}), 0);
  EXPECT_GT(cloth({0.204, y, 0}), 0);
  EXPECT_GT(cloth({0.28, y, 0.1}), 0);
  EXPECT_LT(sleeve({0.22, y, 0}), 0);
  EXPECT_GT(sleeve({0.216, y, 0}), 0);
  EXPECT_GT(sleeve({0.16, y, 0.1}), 0);
  EXPECT_NEAR(sleeve({0.216, y, 0}), 0.002, 1e-3);  // metres
  // Above the gap and on the body's other side they stay whole.
  for (const Field& layer : {cloth, sleeve}) {
    EXPECT_LT(layer({0.21, *gap.start_y() + 0.01, 0}), 0);
    EXPECT_EQ(layer({-0.21, y, 0}), -0.05);
  }
}

// Wide sleeves on bent arms hang before the trunk. What is left of them on its side of the gap made handles and shreds,
// and a shirt that was cut closer than asked.
TEST(Underarm, WideSleevesOfBentArmsAreWornAsAsked) {
  BodySpec who = sampled("woman", 8814);
  who.pose = "bent_arms";
  GarmentSpec spec = garment("shirt", 0.91);
  spec.ease_m = 0.191;
  spec.neck = "v";
  spec.cloth_edge_m = 0.016;
  const Body body = make_body(who);
  const GarmentShape shape = shirt_shape(spec, body, {}, 1);
  const Topology whole = topology(contour(shape.parted, shape.box, 0.008));
  EXPECT_TRUE(whole.closed());
  EXPECT_EQ(whole.components, 1);
  EXPECT_EQ(whole.euler(), 2);
  const Garment shirt = make_garment(spec, body, {}, 1);
  expect_well_cut(shirt, {"neck", "left_cuff", "right_cuff", "hem"});
  expect_at_rest(shirt, body.mesh, {});
  for (const int cuff : {1, 2}) {
    double girth = 0;
    const auto& rim = shirt.rims[cuff].points;
    for (size_t i = 0; i < rim.size(); ++i) girth += (rim[i] - rim[(i + 1) % rim.size()]).norm();
    EXPECT_GT(girth, 0.41) << cuff;
  }
}

}  // namespace
}  // namespace dressform
