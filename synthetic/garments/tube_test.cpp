#include "synthetic/garments/tube.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dressform {
namespace {

LimbSection section(double s, double exponent) { return {s, {0, 0}, 0.2, 0.2, 0.1, 0.1, exponent}; }

TEST(LimbSection, KnownOutlines) {
  EXPECT_NEAR(section(0, 2).radius(0), 0.2, 1e-12);
  EXPECT_NEAR(section(0, 2).radius(M_PI / 2), 0.1, 1e-12);
  EXPECT_NEAR(section(0, 200).radius(std::atan2(0.1, 0.2)), std::hypot(0.1, 0.2), 1e-3);  // a rectangle's corner
  const LimbSection circle{0, {0, 0}, 0.1, 0.1, 0.1, 0.1, 2};
  EXPECT_NEAR(circle.perimeter(), 2 * M_PI * 0.1, 1e-4);
  EXPECT_NEAR(circle.scaled_to_perimeter(1).u_plus, 1 / (2 * M_PI), 1e-4);
}

// Beside a nearly rectangular section the outlines still stay between a rhombus and the rectangle.
TEST(LimbSection, InterpolatedOutlinesAreConvexBesideSquareOnes) {
  for (const double square : {10.0, 40.0, 120.0, 200.0}) {
    const std::vector<LimbSection> sections{section(0, 2.6), section(0.1, square), section(0.2, square / 2),
                                            section(0.3, 2.3), section(0.4, 2.1)};
    for (double s = 0; s <= 0.4; s += 0.005) {
      const LimbSection between = interpolate(sections, s);
      for (double angle = 0; angle < 6.28; angle += 0.1) {
        const double x = std::abs(std::cos(angle)) / 0.2, y = std::abs(std::sin(angle)) / 0.1;
        const double radius = between.radius(angle);
        ASSERT_GE(radius, (1 - 1e-9) / (x + y)) << square << " " << s;
        ASSERT_LE(radius, (1 + 1e-9) / std::max(x, y)) << square << " " << s;
      }
    }
  }
}

// The field is the distance to first order.
TEST(Tube, FieldOfACylinder) {
  const Tube tube = Tube::from_sections({}, {{0, {0, 0}, 0.1, 0.1, 0.1, 0.1, 2}, {0.5, {0, 0}, 0.1, 0.1, 0.1, 0.1, 2}});
  EXPECT_NEAR(tube.field({0.13, 0.2, 0}), 0.03, 1e-4);
  EXPECT_NEAR(tube.field({0, 0.3, -0.08}), -0.02, 1e-4);
  EXPECT_NEAR(tube.field({0, 0.54, 0}), 0.04, 1e-4);
  EXPECT_NEAR((tube.point(0.25, 1.1, 0.07) - Vector3d(0.07 * std::cos(1.1), 0.25, 0.07 * std::sin(1.1))).norm(), 0,
              1e-12);
}

}  // namespace
}  // namespace dressform
