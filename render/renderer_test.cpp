#include <gmock/gmock.h>

#include "render/color_map.h"
#include "render/testing/render_scenes.h"

namespace dressform {
namespace {

using namespace render_scenes;

TEST_F(RendererTest, SquareCoversTheExpectedPixels) {
  const Mesh mesh = square(1, 2);  // 20 pixels to each side of (49.5, 39.5): columns 30 to 69, rows 20 to 59
  const cv::Mat mask = renderer().mask(simple_view(), {item_of(mesh)});
  ASSERT_EQ(mask.type(), CV_8UC1);
  cv::Mat expected(80, 100, CV_8UC1, cv::Scalar(0));
  expected(cv::Rect(30, 20, 40, 40)).setTo(255);
  EXPECT_TRUE(same(mask, expected));
}

TEST_F(RendererTest, PrincipalPointMovesTheImage) {
  RenderView view = simple_view();
  view.camera.cx += 10;
  view.camera.cy -= 5;
  const Mesh mesh = square(1, 2);
  const cv::Mat mask = renderer().mask(view, {item_of(mesh)});
  cv::Mat expected(80, 100, CV_8UC1, cv::Scalar(0));
  expected(cv::Rect(40, 15, 40, 40)).setTo(255);
  EXPECT_TRUE(same(mask, expected));
}

TEST_F(RendererTest, MaskOfASphereHasItsArea) {
  RenderView view = simple_view();
  view.camera.width = view.camera.height = 600;
  view.camera.fx = view.camera.fy = 4000;
  view.camera.cx = view.camera.cy = 299.5;
  const Mesh mesh = sphere(0.5, {0, 0, 10}, 100);
  const double radius_px = 4000 * 0.5 / std::sqrt(10 * 10 - 0.5 * 0.5);
  EXPECT_NEAR(cv::countNonZero(renderer().mask(view, {item_of(mesh)})) / (M_PI * radius_px * radius_px), 1, 0.002);
}

TEST_F(RendererTest, NearerSurfaceHidesFartherInAnyOrder) {
  const Mesh near_square = square(0.5, 1.5), far_square = square(1, 2);
  RenderItem near_item = item_of(near_square, Shading::points), far_item = item_of(far_square);
  near_item.shading = far_item.shading = Shading::shaded;
  near_item.color = {1, 0, 0};
  far_item.color = {0, 0, 1};
  const cv::Mat first = renderer().render(simple_view(), {near_item, far_item});
  const cv::Mat second = renderer().render(simple_view(), {far_item, near_item});
  EXPECT_TRUE(same(first, second));
  EXPECT_GT(pixel(first, 50, 40)[2], 100);
  EXPECT_EQ(pixel(first, 50, 40)[0], 0);
  EXPECT_GT(pixel(first, 33, 23)[0], 100);
}

TEST_F(RendererTest, EdgesAreAntialiased) {
  const Mesh mesh{{{-1, 1, 2}, {1, 0.9, 2}, {1, -0.8, 2}}, {{0, 1, 2}}};
  const cv::Mat smooth = renderer().render(simple_view(), {item_of(mesh)});
  const cv::Mat hard = renderer().render(simple_view(), {item_of(mesh)}, {1, {1, 1, 1}, false});
  const auto levels = [](const cv::Mat& image) {
    std::set<int> found;
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) found.insert(pixel(image, x, y)[0]);
    return found.size();
  };
  EXPECT_GE(levels(smooth), levels(hard) + 3);
}

TEST_F(RendererTest, BackgroundAndTransparency) {
  const Mesh mesh = square(1, 2);
  const cv::Mat colored = renderer().render(simple_view(), {item_of(mesh)}, {4, {1, 0, 0.2f}, false});
  EXPECT_EQ(pixel(colored, 3, 3), cv::Vec3b(51, 0, 255));
  const cv::Mat clear = renderer().render(simple_view(), {item_of(mesh)}, {4, {1, 1, 1}, true});
  ASSERT_EQ(clear.type(), CV_8UC4);
  EXPECT_EQ(clear.at<cv::Vec4b>(3, 3)[3], 0);
  EXPECT_EQ(clear.at<cv::Vec4b>(40, 50)[3], 255);
}

TEST_F(RendererTest, HalfOpaqueItemLetsTheOneBehindShowThrough) {
  const Mesh front = square(1, 2), back = square(1, 2.2);
  RenderItem glass = item_of(front), wall = item_of(back);
  glass.color = {0, 0, 1};
  wall.color = {1, 0, 0};
  glass.opacity = 0.5f;
  const cv::Vec3b mixed = pixel(renderer().render(simple_view(), {glass, wall}), 50, 40);
  EXPECT_GT(mixed[0], 60);
  EXPECT_GT(mixed[2], 60);
}

TEST_F(RendererTest, SameBytesTwiceAndFromAnotherRenderer) {
  const Mesh mesh = sphere(0.7, {0.1, 0.05, 2}, 24);
  const std::vector<RenderItem> items{item_of(mesh)};
  const cv::Mat first = renderer().render(simple_view(), items);
  EXPECT_TRUE(same(first, renderer().render(simple_view(), items)));
  Renderer other;
  EXPECT_TRUE(same(first, other.render(simple_view(), items)));
  EXPECT_TRUE(same(first, renderer().render(simple_view(), items)));
}

TEST_F(RendererTest, FarFromTheOriginTheImageIsTheSame) {
  const Vector3d far_away(1000, -500, 2000);
  const Mesh here = sphere(0.7, {0, 0, 2}, 24), there = sphere(0.7, far_away + Vector3d(0, 0, 2), 24);
  RenderView view = simple_view();
  const cv::Mat expected = renderer().render(view, {item_of(here)});
  view.camera_from_world.translation() = -far_away;
  EXPECT_LE(cv::norm(renderer().render(view, {item_of(there)}), expected, cv::NORM_INF), 3);
}

TEST_F(RendererTest, UglyInput) {
  const Mesh empty, broken{{{0, 0, 1}}, {{0, 0, 7}}};
  Mesh holed = square(1, 2);
  holed.vertices[0].x() = std::nan("");
  const cv::Mat blank = renderer().render(simple_view(), {item_of(empty)});
  EXPECT_EQ(cv::norm(blank, cv::Mat(80, 100, CV_8UC3, cv::Scalar::all(255)), cv::NORM_INF), 0);
  EXPECT_TRUE(same(renderer().render(simple_view(), {}), blank));
  EXPECT_TRUE(same(renderer().render(simple_view(), {item_of(holed)}), blank));  // the vertex is in both triangles
  EXPECT_THROW(renderer().render(simple_view(), {item_of(broken)}), std::invalid_argument);
  EXPECT_THROW(renderer().render(simple_view(), {RenderItem{}}), std::invalid_argument);
  EXPECT_THROW(renderer().render(simple_view(), {item_of(holed, Shading::scalar)}), std::invalid_argument);
  EXPECT_THROW(renderer().render(simple_view(), {item_of(holed, Shading::textured)}), std::invalid_argument);
  EXPECT_THROW(renderer().render(simple_view(), {}, {3, {1, 1, 1}, false}), std::invalid_argument);
  EXPECT_THROW(renderer().render(RenderView{}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
