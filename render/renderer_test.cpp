#include "render/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "render/color_map.h"

namespace dressform {
namespace {

// Camera of 100 x 80 pixels at the origin, looking along +z, y down: one metre at z = 1 is 40 pixels.
RenderView simple_view() {
  RenderView view;
  view.camera.width = 100;
  view.camera.height = 80;
  view.camera.fx = view.camera.fy = 40;
  view.camera.cx = 49.5;
  view.camera.cy = 39.5;
  return view;
}

// Square [-half, half]^2 at depth z that faces the camera of simple_view (counter-clockwise for it), corners in the
// order top left, bottom left, bottom right, top right.
Mesh square(double half, double z) {
  return {{{-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

TexturedMesh textured_square(const cv::Mat& texture) {
  TexturedMesh result{square(1, 2), {}, texture};
  const Vector2f uv[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  for (const Vector3i& t : result.mesh.triangles) result.corner_uv.push_back({uv[t[0]], uv[t[1]], uv[t[2]]});
  return result;
}

Mesh sphere(double radius, const Vector3d& center, int rings) {
  Mesh mesh;
  const int sectors = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / sectors;
      mesh.vertices.push_back(center + radius * Vector3d(std::sin(polar) * std::sin(turn), std::cos(polar),
                                                         std::sin(polar) * std::cos(turn)));
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int a = i * sectors + j, b = i * sectors + (j + 1) % sectors, c = a + sectors, d = b + sectors;
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    }
  return mesh;
}

RenderItem item_of(const Mesh& mesh, Shading shading = Shading::shaded) {
  RenderItem item;
  item.mesh = &mesh;
  item.shading = shading;
  return item;
}

RenderItem item_of(const TexturedMesh& mesh, Shading shading = Shading::unlit) {
  RenderItem item;
  item.textured = &mesh;
  item.shading = shading;
  return item;
}

RenderItem item_of(const PointCloud& points) {
  RenderItem item;
  item.points = &points;
  item.shading = Shading::points;
  return item;
}

cv::Vec3b pixel(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x); }

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

class RendererTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { renderer_ = new Renderer; }
  static void TearDownTestSuite() {
    delete renderer_;
    renderer_ = nullptr;
  }
  static Renderer& renderer() { return *renderer_; }

 private:
  static Renderer* renderer_;
};
Renderer* RendererTest::renderer_ = nullptr;

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
