#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "render/color_map.h"
#include "render/renderer.h"

namespace dressform {
namespace {

// Thin box with one colour a side, 0.6 x 1.8 x 0.4 m, its lowest point at y = 0.
TexturedMesh colored_box() {
  TexturedMesh box;
  const double x = 0.3, y = 1.8, z = 0.2;
  box.mesh.vertices = {{-x, 0, z}, {x, 0, z}, {x, y, z}, {-x, y, z}, {-x, 0, -z}, {x, 0, -z}, {x, y, -z}, {-x, y, -z}};
  const int sides[4][4] = {{0, 1, 2, 3}, {1, 5, 6, 2}, {5, 4, 7, 6}, {4, 0, 3, 7}};  // +z, +x, -z, -x
  box.texture = cv::Mat(8, 32, CV_8UC3);
  const cv::Scalar colors[4] = {{0, 0, 250}, {0, 250, 0}, {250, 0, 0}, {0, 250, 250}};
  for (int i = 0; i < 4; ++i) {
    box.texture(cv::Rect(8 * i, 0, 8, 8)).setTo(colors[i]);
    const Vector2f uv((8 * i + 4) / 32.f, 0.5f);
    for (int k = 1; k < 3; ++k) {
      box.mesh.triangles.push_back({sides[i][0], sides[i][k], sides[i][k + 1]});
      box.corner_uv.push_back({uv, uv, uv});
    }
  }
  return box;
}

TEST(LookAtBox, CornersAreInsideFromEverywhere) {
  const Vector3d low(-0.5, 0, -0.2), high(0.7, 1.9, 0.4);
  for (int azimuth = 0; azimuth < 360; azimuth += 30)
    for (const double elevation : {-30., 0., 45., 80.}) {
      const RenderView view = look_at_box(low, high, azimuth, elevation, 320, 400);
      double widest = 0;
      for (int i = 0; i < 8; ++i) {
        const Vector3d corner(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
        const Vector3d p = view.camera_from_world * corner;
        ASSERT_GT(p.z(), 0);
        const double u = (view.camera.fx * p.x() / p.z() + view.camera.cx - 159.5) / 160;
        const double v = (view.camera.fy * p.y() / p.z() + view.camera.cy - 199.5) / 200;
        widest = std::max({widest, std::abs(u), std::abs(v)});
      }
      EXPECT_LE(widest, 1) << azimuth << " " << elevation;
      EXPECT_GE(widest, 0.6) << azimuth << " " << elevation;
    }
}

TEST(LookAtBox, LooksFromTheAskedSideAndIsARotation) {
  const RenderView view = look_at_box({-1, -1, -1}, {1, 1, 1}, 90, 0, 100, 100);
  const Vector3d eye = view.camera_from_world.inverse().translation();
  EXPECT_GT(eye.x(), 2);
  EXPECT_NEAR(eye.z(), 0, 1e-9);
  EXPECT_NEAR(view.camera_from_world.linear().determinant(), 1, 1e-12);
  EXPECT_LT((view.camera_from_world * Vector3d(0, 1, 0)).y(), 0);  // up is up
  EXPECT_LT((view.camera_from_world * Vector3d(0, 0, 1)).x(), 0);  // +z is to the left when seen from +x
}

TEST(Layouts, FourViewsShowFrontLeftBackRight) {
  Renderer renderer;
  const TexturedMesh box = colored_box();
  RenderItem item;
  item.textured = &box;
  item.shading = Shading::unlit;
  const cv::Mat sheet = four_views(renderer, {item}, 200);
  ASSERT_EQ(sheet.rows, 200);
  ASSERT_EQ(sheet.cols % 4, 0);
  const cv::Vec3b expected[4] = {{0, 0, 250}, {0, 250, 0}, {250, 0, 0}, {0, 250, 250}};
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(sheet.at<cv::Vec3b>(100, sheet.cols / 4 * i + sheet.cols / 8), expected[i]) << i;
}

TEST(Layouts, ContactSheetHasItsTiles) {
  Renderer renderer;
  const TexturedMesh box = colored_box();
  RenderItem item;
  item.textured = &box;
  item.shading = Shading::textured;
  const cv::Mat sheet = contact_sheet(renderer, {item}, 7, 3, 90);
  EXPECT_EQ(sheet.rows, 270);
  EXPECT_EQ(sheet.cols % 3, 0);
  EXPECT_EQ(sheet.at<cv::Vec3b>(225, sheet.cols / 2), cv::Vec3b::all(255));  // the eighth tile is empty
  EXPECT_THROW(contact_sheet(renderer, {}, 4, 2, 90), std::invalid_argument);
  EXPECT_THROW(contact_sheet(renderer, {item}, 0, 2, 90), std::invalid_argument);
}

TEST(ColorBar, IsAppendedWithItsColoursInOrder) {
  const cv::Mat image(600, 300, CV_8UC3, cv::Scalar(10, 20, 30));
  const cv::Mat result = with_color_bar(image, -2, 12.5, "mm", "distance");
  ASSERT_EQ(result.rows, 600);
  ASSERT_GT(result.cols, 340);
  EXPECT_EQ(cv::norm(result(cv::Rect(0, 0, 300, 600)), image, cv::NORM_INF), 0);
  const cv::Vec3b lowest = scalar_colors().at<cv::Vec3b>(2), highest = scalar_colors().at<cv::Vec3b>(253);
  int lowest_row = -1, highest_row = -1;
  for (int y = 0; y < result.rows; ++y)
    for (int x = 300; x < result.cols; ++x) {
      const cv::Vec3b c = result.at<cv::Vec3b>(y, x);
      if (cv::norm(c, lowest, cv::NORM_INF) <= 2) lowest_row = y;
      if (cv::norm(c, highest, cv::NORM_INF) <= 2 && highest_row < 0) highest_row = y;
    }
  EXPECT_GT(lowest_row, 500);
  EXPECT_LT(highest_row, 150);
  EXPECT_GE(highest_row, 0);
}

TEST(ColorBar, SurvivesSmallImagesAndRefusesEmptyRanges) {
  EXPECT_EQ(with_color_bar(cv::Mat(20, 20, CV_8UC3, cv::Scalar()), 0, 1e-4, "", "").rows, 20);
  EXPECT_THROW(with_color_bar(cv::Mat(20, 20, CV_8UC3, cv::Scalar()), 1, 1, "mm", "t"), std::invalid_argument);
  EXPECT_THROW(with_color_bar(cv::Mat(), 0, 1, "mm", "t"), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
