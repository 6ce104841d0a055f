// The variants that go by points and labels alone, without fitted rims.
#include <gtest/gtest.h>

#include "pipeline/open/open.h"
#include "pipeline/open/place_votes.h"
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
  for (const std::string variant : {"density_trim", "min_cut"}) {
    FieldValues values;
    if (variant == "density_trim") values["quantile"] = skirt.part_without_points;
    const OpenGarments open = Open::at(variant).run({}, {}, skirt.body, {}, {}, skirt.closed, values, 1);
    ASSERT_TRUE(open.garments.count("bottom")) << variant << ": " << open.failed.at("bottom");
    ASSERT_EQ(open.garments.at("bottom").rims.size(), 2u) << variant;
    for (const Rim& rim : open.garments.at("bottom").rims)
      for (const Vector3d& p : rim.points)
        EXPECT_NEAR(p.y(), rim.name == "hem" ? skirt.kLow_m : skirt.kHigh_m, 0.035) << variant << " " << rim.name;
  }
}

TEST(PlaceVotes, TheViewsTellClothFromWhatIsBelowTheHem) {
  const figure::Capture capture = figure::capture({}, 0, 0.25);
  figure::Clothes longer = capture.clothes;
  longer.hem_y -= 0.06;
  const Mesh mesh = figure::surface_of({-0.5, 0.85, -0.25}, {0.5, 1.6, 0.25}, 0.02,
                                       [&](const Vector3d& p) { return figure::shirt(p, longer); });
  const OpenScene scene{capture.session, capture.segmentation, capture.body.landmarks,
                        depth_views(capture.session, capture.calibration, capture.registration.model_from_sensor),
                        MeshQuery(capture.body.body)};
  const PlaceVotes votes = place_votes(mesh, Label::top, false, scene, 0.03, 0.5);
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  int cloth = 0, below = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d& p = mesh.vertices[i];
    if (normals[i].z() < 0.9 || std::abs(p.x()) > 0.06) continue;
    if (p.y() > capture.clothes.hem_y + 0.04 && p.y() < 1.2) {
      EXPECT_GE(votes.garment[i], 1) << p.transpose();
      EXPECT_EQ(votes.elsewhere[i], 0) << p.transpose();
      ++cloth;
    }
    if (p.y() < capture.clothes.hem_y - 0.03 && p.y() > longer.hem_y + 0.01) {
      EXPECT_EQ(votes.garment[i], 0) << p.transpose();
      EXPECT_GE(votes.elsewhere[i], 1) << p.transpose();
      ++below;
    }
  }
  EXPECT_GT(cloth, 20);
  EXPECT_GT(below, 2);
}

}  // namespace
}  // namespace dressform
