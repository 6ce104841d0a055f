// The variant that goes by points alone, without fitted rims.
#include <gtest/gtest.h>

#include "pipeline/open/open.h"
#include "pipeline/open/support_distance.h"
#include "pipeline/testing/dressed_figure.h"

namespace dressform {
namespace {

TEST(SupportDistances, OfThePointsThatAreThere) {
  const std::vector<Vector3d> line{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(support_distances({{0.25, 0, 0}}, line, 1), std::vector<double>{0.25});
  EXPECT_EQ(support_distances({{0.25, 0, 0}}, line, 3), std::vector<double>{2.75});
  EXPECT_TRUE(std::isinf(support_distances({{0, 0, 0}}, line, 4)[0]));
}

// A closed skirt with points on it between two heights, and nothing else known.
struct SkirtOfPoints {
  static constexpr double kLow_m = 0.55, kHigh_m = 1.03;
  figure::Clothes clothes;
  KnownBody body = known_body(figure::body_mesh());
  ClosedGarments closed;
  double part_without_points = 0;

  SkirtOfPoints() {
    clothes.skirt = true;
    clothes.ankle_y = 0.5;
    ClosedGarment& skirt = closed.garments["bottom"];
    skirt.layout.kind = "skirt";
    skirt.mesh = figure::surface_of({-0.45, 0.45, -0.45}, {0.45, 1.15, 0.45}, 0.015,
                                    [&](const Vector3d& p) { return figure::bottom(p, clothes); });
    for (const Vector3d& v : skirt.mesh.vertices)
      if (v.y() > kLow_m && v.y() < kHigh_m) skirt.support.points.push_back(v);
    part_without_points = 1 - static_cast<double>(skirt.support.points.size()) / skirt.mesh.vertices.size();
  }
};

TEST(OpenByPoints, ASkirtEndsWhereItsPointsDo) {
  const SkirtOfPoints skirt;
  const FieldValues values{{"quantile", skirt.part_without_points}};
  const OpenGarments open = Open::at("density_trim").run({}, {}, skirt.body, {}, {}, skirt.closed, values, 1);
  ASSERT_TRUE(open.garments.count("bottom")) << open.failed.at("bottom");
  ASSERT_EQ(open.garments.at("bottom").rims.size(), 2u);
  for (const Rim& rim : open.garments.at("bottom").rims)
    for (const Vector3d& p : rim.points)
      EXPECT_NEAR(p.y(), rim.name == "hem" ? skirt.kLow_m : skirt.kHigh_m, 0.035) << rim.name;
}

}  // namespace
}  // namespace dressform
