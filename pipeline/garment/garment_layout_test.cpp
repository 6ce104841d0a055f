#include "pipeline/garment/garment_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "pipeline/garment/garment_ends.h"
#include "pipeline/garment/garment_kind.h"
#include "pipeline/garment/worn_order.h"
#include "pipeline/testing/dressed_figure.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

TEST(GarmentEnds, ClothBesideAHandIsNoSleeve) {
  const Mesh body = figure::body_mesh();
  const MeshQuery naked(body);
  const Landmarks limbs = find_landmarks(body);
  PointCloud cloud;
  for (double t = 0; t < 1; t += 0.01)
    for (int i = 0; i < 30; ++i) {
      const double angle = 2 * M_PI * i / 30;
      const Vector3d round(0.06 * std::cos(angle), 0, 0.06 * std::sin(angle));
      cloud.points.push_back(figure::shoulder(1) + 0.4 * t * (figure::hand(1) - figure::shoulder(1)) + round);
      if (std::cos(angle) < 0) cloud.points.push_back(figure::hand(1) + Vector3d(0, 0.1 * t, 0) + round);
    }
  GarmentLayout shirt;
  shirt.kind = "shirt";
  shirt = with_ends(shirt, cloud.points, naked, limbs);
  const double hand = limbs.left_arm->along(figure::hand(1));
  EXPECT_GT(shirt.arms[0].end_m, 0.1);
  EXPECT_LT(shirt.arms[0].end_m, hand - 0.25);
}

TEST(GarmentEnds, HiddenBottomsReachTheWaistHoweverLongTheTop) {
  Landmarks limbs;
  limbs.waist_y = 1.05;
  GarmentLayout top, bottom;
  top.top_y = 1.45;
  bottom.bottom_y = 0.3;
  for (const double hem : {1.0, 0.75, 0.5}) {
    top.bottom_y = hem;
    bottom.top_y = hem + 0.01;
    EXPECT_EQ(up_to_the_waist(bottom, top, limbs).top_y, 1.05) << hem;
    EXPECT_EQ(up_to_the_waist(bottom, top, limbs).bottom_y, 0.3);
  }
  bottom.top_y = 1.02;  // below the waist by its own cut, skin above it
  top.bottom_y = 1.2;
  EXPECT_EQ(up_to_the_waist(bottom, top, limbs).top_y, 1.02);
}

// A ring of points round the figure's waist.
void add_ring(double radius, double low, double high, PointCloud& cloud) {
  for (double y = low; y < high; y += 0.008)
    for (int i = 0; i < 90; ++i) {
      const double angle = 2 * M_PI * i / 90;
      cloud.points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
}

TEST(WornOrder, TheOuterGarmentIsTheOneFurtherOffTheBody) {
  const Mesh body = figure::body_mesh();
  const MeshQuery naked(body);
  const Landmarks limbs = find_landmarks(body);
  const auto tucked = [&](double top_m, double bottom_m, double gap_m) {
    PointCloud top, bottom;
    add_ring(0.15 + top_m, 1.04 + gap_m, 1.3, top);
    add_ring(0.15 + bottom_m, 0.9, 1.04, bottom);
    return worn_order(top, bottom, naked, limbs).top == Worn::under;
  };
  EXPECT_TRUE(tucked(0.01, 0.02, 0));
  EXPECT_TRUE(tucked(0.01, 0.02, 0.03));
  EXPECT_FALSE(tucked(0.02, 0.01, 0));
  EXPECT_FALSE(tucked(0.01, 0.01, 0));
  EXPECT_FALSE(tucked(0.01, 0.02, 0.15));  // skin between them
  EXPECT_EQ(worn_order({}, {}, naked, limbs).top, Worn::alone);
}

TEST(ClosedBottomKind, IsWhatTheSurfaceIs) {
  const Landmarks limbs = find_landmarks(figure::body_mesh());
  figure::Clothes clothes;
  const auto kind = [&] {
    const Mesh closed = figure::surface_of({-0.4, 0.1, -0.4}, {0.4, 1.15, 0.4}, 0.015,
                                           [&](const Vector3d& p) { return figure::bottom(p, clothes); });
    return closed_bottom_kind(closed, limbs, {"unknown", 0}).kind;
  };
  EXPECT_EQ(kind(), "trousers");
  clothes.skirt = true;
  EXPECT_EQ(kind(), "skirt");
  clothes.ankle_y = limbs.crotch_y;
  EXPECT_EQ(kind(), "unknown");
}

TEST(GarmentLayout, SurvivesTheArchive) {
  GarmentLayout layout;
  layout.kind = "trousers";
  layout.worn = Worn::under;
  layout.legs[1].end_m = 0.7;
  const std::string bytes = to_bytes(layout);
  const auto read = from_bytes<GarmentLayout>(bytes);
  EXPECT_EQ(to_bytes(read), bytes);
  EXPECT_TRUE(read.forked());
  EXPECT_EQ(read.worn, Worn::under);
  std::string damaged = bytes;
  damaged[damaged.size() - 17] = 9;  // the order of the two garments
  EXPECT_THROW(from_bytes<GarmentLayout>(damaged), std::runtime_error);
}

}  // namespace
}  // namespace dressform
