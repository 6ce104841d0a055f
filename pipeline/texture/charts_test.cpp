#include "pipeline/texture/charts.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "pipeline/texture/packing.h"
#include "pipeline/texture/raster.h"
#include "pipeline/texture/textured_tube.h"

namespace dressform {
namespace {

TEST(Packing, BoxesAreInsideAndApart) {
  std::vector<cv::Size> boxes;
  for (int i = 0; i < 60; ++i) boxes.emplace_back(5 + (i * 37) % 90, 5 + (i * 53) % 70);
  const Packing packing = pack(boxes);
  cv::Mat taken(packing.size, CV_8UC1, cv::Scalar(0));
  double area = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const cv::Rect box(packing.at[i], boxes[i]);
    ASSERT_EQ(box & cv::Rect({0, 0}, packing.size), box);
    EXPECT_EQ(cv::countNonZero(taken(box)), 0);
    taken(box) = 255;
    area += box.area();
  }
  EXPECT_GT(area / packing.size.area(), 0.7);
  EXPECT_GT(pack({}).size.area(), 0);
}

// Triangles counted over every texel: none may hold two.
void expect_no_overlap(const Atlas& atlas) {
  cv::Mat count(atlas.size, CV_32SC1, cv::Scalar(0));
  for (const auto& corners : atlas.corners)
    for_each_pixel(corners, {{0, 0}, atlas.size}, [&](int x, int y, const Vector3d& weights) {
      if (weights.minCoeff() > 1e-6) ++count.at<int>(y, x);
    });
  double most = 0;
  cv::minMaxLoc(count, nullptr, &most);
  EXPECT_LE(most, 1);
}

TEST(Charts, WithoutViewsATubeIsLaidOutAlongTheAxes) {
  const Mesh mesh = tube(0.2, 0, 0.6, 48, 12);
  const Labels labels{std::vector<int>(mesh.triangles.size(), -1), std::vector<bool>(mesh.triangles.size(), false)};
  const Atlas atlas = make_atlas(mesh, SurfaceGraph(mesh), {}, labels, {});
  EXPECT_EQ(atlas.charts, 4);
  expect_no_overlap(atlas);
}

TEST(Charts, SurfaceFoldedOverItselfIsCutApart) {
  Mesh mesh;  // a spiral: seen along y every turn lies on the one below
  const int steps = 120;
  for (int i = 0; i <= steps; ++i) {
    const double turn = 2 * M_PI * i / 30.0, y = 0.002 * i;
    mesh.vertices.push_back({0.1 * std::sin(turn), y, 0.1 * std::cos(turn)});
    mesh.vertices.push_back({0.2 * std::sin(turn), y, 0.2 * std::cos(turn)});
  }
  for (int i = 0; i < steps; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  const Labels labels{std::vector<int>(mesh.triangles.size(), -1), std::vector<bool>(mesh.triangles.size(), false)};
  const Atlas atlas = make_atlas(mesh, SurfaceGraph(mesh), {}, labels, {});
  EXPECT_GE(atlas.charts, 4);
  expect_no_overlap(atlas);
}

TEST(Charts, GuttersThatFillTheTextureAloneEndTheShrinking) {
  Mesh mesh;  // a hundred loose triangles
  for (int i = 0; i < 100; ++i) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(0.01, 0, 0), Vector3d(0, 0.01, 0)})
      mesh.vertices.push_back(corner + Vector3d(0.02 * i, 0, 0));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  AtlasParams params;
  params.largest_px = 64;
  const Labels labels{std::vector<int>(mesh.triangles.size(), -1), std::vector<bool>(mesh.triangles.size(), false)};
  const Atlas atlas = make_atlas(mesh, SurfaceGraph(mesh), {}, labels, params);
  EXPECT_EQ(atlas.charts, 100);
  EXPECT_GT(atlas.size.width, 64);
}

}  // namespace
}  // namespace dressform
