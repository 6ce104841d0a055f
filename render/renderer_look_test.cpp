#include <gmock/gmock.h>

#include "render/color_map.h"
#include "render/testing/render_scenes.h"

namespace dressform {
namespace {

using namespace render_scenes;

TEST_F(RendererTest, TextureIsNotMirrored) {
  cv::Mat texture(64, 64, CV_8UC3, cv::Scalar(200, 200, 200));
  texture(cv::Rect(0, 0, 16, 16)).setTo(cv::Scalar(0, 0, 255));   // top left red
  texture(cv::Rect(48, 0, 16, 16)).setTo(cv::Scalar(0, 255, 0));  // top right green
  texture(cv::Rect(0, 48, 16, 16)).setTo(cv::Scalar(255, 0, 0));  // bottom left blue
  const TexturedMesh mesh = textured_square(texture);
  const cv::Mat image = renderer().render(simple_view(), {item_of(mesh)});
  EXPECT_EQ(pixel(image, 34, 24), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(pixel(image, 65, 24), cv::Vec3b(0, 255, 0));
  EXPECT_EQ(pixel(image, 34, 55), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(pixel(image, 50, 40), cv::Vec3b(200, 200, 200));
  EXPECT_EQ(pixel(image, 5, 5), cv::Vec3b(255, 255, 255));
}

TEST_F(RendererTest, UnlitImageEqualsATextureOfItsSize) {
  cv::Mat texture(40, 40, CV_8UC3);
  cv::randu(texture, 0, 256);
  const TexturedMesh mesh = textured_square(texture);
  RenderOptions options;
  options.samples = 1;
  const cv::Mat image = renderer().render(simple_view(), {item_of(mesh)}, options);
  EXPECT_LE(cv::norm(image(cv::Rect(30, 20, 40, 40)), texture, cv::NORM_INF), 2);
}

TEST_F(RendererTest, SmallImageOfAFineTextureIsItsMean) {
  cv::Mat texture(1024, 1024, CV_8UC3);
  for (int y = 0; y < texture.rows; ++y)
    for (int x = 0; x < texture.cols; ++x)
      texture.at<cv::Vec3b>(y, x) = (x + y) % 2 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(200, 200, 200);
  const TexturedMesh mesh = textured_square(texture);
  const cv::Vec3b middle = pixel(renderer().render(simple_view(), {item_of(mesh)}), 50, 40);
  EXPECT_NEAR(middle[0], 100, 2);
}

TEST_F(RendererTest, LitTextureKeepsItsHueAndIsBrighterWhenItFacesTheViewer) {
  const TexturedMesh mesh = textured_square(cv::Mat(8, 8, CV_8UC3, cv::Scalar(60, 120, 180)));
  const cv::Vec3b facing = pixel(renderer().render(simple_view(), {item_of(mesh, Shading::textured)}), 50, 40);
  EXPECT_GT(facing[2], facing[1]);
  EXPECT_GT(facing[1], facing[0]);
  EXPECT_GT(facing[2], 140);
}

TEST_F(RendererTest, NormalsAreColours) {
  const Mesh mesh = square(1, 2);  // faces the viewer: (0.5, 0.5, 1) as RGB
  const cv::Vec3b color = pixel(renderer().render(simple_view(), {item_of(mesh, Shading::normals)}), 50, 40);
  EXPECT_NEAR(color[2], 127.5, 1);
  EXPECT_NEAR(color[1], 127.5, 1);
  EXPECT_EQ(color[0], 255);
  Mesh tilted{{{-1, 1, 2}, {1, 1, 2}, {1, -1, 4}, {-1, -1, 4}}, {{0, 1, 2}, {0, 2, 3}}};  // a floor: looks up
  const cv::Vec3b up = pixel(renderer().render(simple_view(), {item_of(tilted, Shading::normals)}), 50, 40);
  EXPECT_GT(up[1], 200);
  EXPECT_NEAR(up[2], 127.5, 1);
}

TEST_F(RendererTest, InsideIsDarkerOrLeftOut) {
  Mesh away = square(1, 2);
  for (Vector3i& t : away.triangles) std::swap(t[1], t[2]);
  const Mesh facing = square(1, 2);
  RenderItem item = item_of(away);
  const cv::Vec3b inside = pixel(renderer().render(simple_view(), {item}), 50, 40);
  const cv::Vec3b outside = pixel(renderer().render(simple_view(), {item_of(facing)}), 50, 40);
  EXPECT_LT(inside[1], 0.85 * outside[1]);
  item.two_sided = false;
  EXPECT_EQ(pixel(renderer().render(simple_view(), {item}), 50, 40), cv::Vec3b(255, 255, 255));
}

TEST_F(RendererTest, ScalarsTakeTheColoursOfTheBar) {
  const Mesh mesh = square(1, 2);
  const cv::Mat colors = scalar_colors();
  RenderItem item = item_of(mesh, Shading::scalar);
  item.scalar_minimum = 2;
  item.scalar_maximum = 6;
  for (const auto& [value, row] : std::map<double, int>{{2, 0}, {4, 127}, {6, 255}, {-3, 0}, {9, 255}}) {
    item.scalars.assign(4, value);
    const cv::Vec3b found = pixel(renderer().render(simple_view(), {item}), 50, 40);
    const cv::Vec3b expected = colors.at<cv::Vec3b>(row);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2) << value;
  }
  item.scalars.assign(4, std::nan(""));
  EXPECT_EQ(pixel(renderer().render(simple_view(), {item}), 50, 40), cv::Vec3b::all(kNoScalarGrey));
}

TEST_F(RendererTest, WireframeDrawsTheDiagonalAndHidesWhatIsBehind) {
  const Mesh mesh = square(1, 2), behind = square(0.9, 3);
  RenderItem item = item_of(mesh, Shading::wireframe), hidden = item_of(behind, Shading::wireframe);
  item.color = hidden.color = {0.1f, 0.2f, 0.7f};
  const cv::Mat image = renderer().render(simple_view(), {item, hidden});
  EXPECT_TRUE(same(image, renderer().render(simple_view(), {item})));
  EXPECT_LT(pixel(image, 45, 35)[1], 100);  // on the diagonal
  EXPECT_GT(pixel(image, 60, 35)[1], 150);  // inside a triangle
}

TEST_F(RendererTest, PointsShowTheirColours) {
  PointCloud cloud;
  cloud.points = {{0, 0, 1}, {0.5, 0, 1}, {std::nan(""), 0, 1}};
  cloud.colors = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  const cv::Mat image = renderer().render(simple_view(), {item_of(cloud)}, {1, {0, 0, 0}, false});
  EXPECT_EQ(pixel(image, 49, 39)[2] + pixel(image, 50, 40)[2] > 200, true);
  cv::Mat blue;
  cv::extractChannel(image, blue, 0);
  EXPECT_GE(cv::countNonZero(blue), 1);
  EXPECT_LE(cv::countNonZero(blue), 6);
}

}  // namespace
}  // namespace dressform
