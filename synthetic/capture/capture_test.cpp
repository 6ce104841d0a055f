#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "synthetic/capture/color_camera.h"
#include "synthetic/capture/ir_view.h"
#include "synthetic/capture/shapes.h"
#include "synthetic/capture/visibility.h"

namespace dressform {
namespace {

Camera color_camera() { return Camera{480, 270, 268, 267, 235, 133, {0.0594, -0.0628, -0.00158, -0.00115, 0.0078}}; }

RaySurface surface(const char* name, Mesh mesh, const Vector3f& albedo, Label label = Label::none, bool smooth = true) {
  RaySurface result;
  result.name = name;
  result.mesh = std::move(mesh);
  result.smooth = smooth;
  result.material.albedo_rgb = albedo;
  result.label = label;
  return result;
}

Lighting lamps() {
  LightSpec lamp;
  lamp.position_m = {0.8, -1.5, 0.2};
  lamp.intensity_rgb = Vector3d::Ones() * 3;
  return make_lighting({lamp}, RoomSpec{});
}

// A dark wall 3 m before the camera (at the origin, looking along +z).
RaySurface wall(const Vector3f& albedo) {
  return surface("wall", grid_mesh({-6, 6, 3}, {12, 0, 0}, {0, -12, 0}, 0.2), albedo, Label::none, false);
}

cv::Mat render(const RayScene& scene, const Camera& camera, FilmSpec film = {}, Seed seed = 1) {
  const Lighting lighting = lamps();
  const IndirectLight indirect(scene, lighting);
  return render_color(scene, lighting, indirect, RayTable(camera), Isometry3d::Identity(), film, seed);
}

TEST(RayTable, InvertsTheDistortionBetweenPixelsToo) {
  const Camera camera = color_camera();
  const RayTable table(camera);
  for (const Vector2d& pixel : {Vector2d(0.3, 0.2), Vector2d(240.5, 120.25), Vector2d(479.1, 268.7)}) {
    const Vector2f ideal = table.at(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    const Vector2d back = camera.project(Vector3d(ideal.x(), ideal.y(), 1));
    EXPECT_LT((back - pixel).norm(), 2e-3);
  }
}

// Small bright balls land where the distorted camera projects their centres.
TEST(ColorCamera, KnownPointsLandWhereTheCameraProjectsThem) {
  const Camera camera = color_camera();
  for (const Vector3d& point : {Vector3d(-1.4, -0.7, 1.9), Vector3d(1.3, 0.75, 1.9), Vector3d(0.1, 0, 1.5)}) {
    std::vector<RaySurface> surfaces;
    surfaces.push_back(surface("ball", sphere_mesh(point, 0.03, 20), Vector3f::Zero(), Label::top));
    surfaces.back().material.emission_rgb = Vector3f::Ones();
    const cv::Mat image = render(RayScene(std::move(surfaces)), camera);
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::threshold(grey, grey, 128, 255, cv::THRESH_BINARY);
    const cv::Moments moments = cv::moments(grey, true);
    const Vector2d centre(moments.m10 / moments.m00, moments.m01 / moments.m00);
    EXPECT_LT((centre - camera.project(point)).norm(), 0.25) << point.transpose();
  }
}

// A white dot printed at a known spot of a black cloth appears at that spot's pixel.
TEST(ColorCamera, PrintLandsOnItsSpotOfCloth) {
  const Camera camera = color_camera();
  const Vector3d corner(-0.5, -0.4, 2), u(1, 0, 0.2), v(0, 0.8, 0);
  RaySurface cloth = surface("cloth", grid_mesh(corner, u, v, 0.1), Vector3f::Ones(), Label::top);
  cloth.corner_uv = grid_uv(cloth.mesh, corner, u, v);
  cloth.texture = cv::Mat(400, 500, CV_8UC3, cv::Scalar::all(0));
  cv::circle(cloth.texture, {375, 100}, 12, cv::Scalar::all(255), cv::FILLED);
  std::vector<RaySurface> surfaces;
  surfaces.push_back(std::move(cloth));
  cv::Mat grey;
  cv::cvtColor(render(RayScene(std::move(surfaces)), camera), grey, cv::COLOR_BGR2GRAY);
  double most;
  cv::minMaxLoc(grey, nullptr, &most);
  cv::threshold(grey, grey, 0.5 * most, 255, cv::THRESH_BINARY);
  const cv::Moments moments = cv::moments(grey, true);
  const Vector3d spot = corner + u * (375.5 / 500) + v * (100.5 / 400);
  const Vector2d centre(moments.m10 / moments.m00, moments.m01 / moments.m00);
  EXPECT_LT((centre - camera.project(spot)).norm(), 0.3);
}

TEST(ColorCamera, FineChequersAverageInsteadOfAliasing) {
  const Vector3d corner(-3, -3, 3), u(6, 0, 0), v(0, 6, 0);
  RaySurface cloth = surface("cloth", grid_mesh(corner, u, v, 0.5), Vector3f::Ones());
  cloth.corner_uv = grid_uv(cloth.mesh, corner, u, v);
  cloth.texture = cv::Mat(2000, 2000, CV_8UC3, cv::Scalar::all(0));
  for (int y = 0; y < 2000; ++y)
    for (int x = y % 2; x < 2000; x += 2) cloth.texture.at<cv::Vec3b>(y, x) = {255, 255, 255};
  std::vector<RaySurface> surfaces;
  surfaces.push_back(std::move(cloth));
  FilmSpec quiet;
  quiet.electrons_full_scale = 1e9f;
  const cv::Mat image = render(RayScene(std::move(surfaces)), color_camera(), quiet);
  const cv::Mat patch = image(cv::Rect(200, 120, 20, 20));
  cv::Scalar mean, deviation;
  cv::meanStdDev(patch, mean, deviation);
  EXPECT_GT(mean[1], 20);
  EXPECT_LT(deviation[1], 0.06 * mean[1]);
}

TEST(ColorCamera, ShadowsAreDarkerButNotBlack) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(wall(Vector3f::Constant(0.6f)));
  surfaces.push_back(surface("ball", sphere_mesh({0.3, -0.4, 1.8}, 0.25, 40), Vector3f::Constant(0.5f)));
  const RayScene scene(std::move(surfaces));
  const Lighting lighting = lamps();
  // The ball's shadow on the wall: from the lamp through the ball's centre.
  const Vector3d lamp = lighting.bulbs[0].position_m, through = Vector3d(0.3, -0.4, 1.8) - lamp;
  const Vector3d shadow = lamp + through * ((3 - lamp.z()) / through.z());
  const Camera camera = color_camera();
  const cv::Mat image = render(scene, camera);
  const auto at = [&](const Vector3d& point) {
    const Vector2d pixel = camera.project(point);
    return cv::mean(image(cv::Rect(static_cast<int>(pixel.x()) - 2, static_cast<int>(pixel.y()) - 2, 5, 5)))[1];
  };
  EXPECT_LT(at(shadow), 0.85 * at(shadow + Vector3d(1.1, 0, 0)));
  EXPECT_GT(at(shadow), 15);
}

TEST(ColorCamera, GreyLandsMidScaleAndWhiteDoesNotClip) {
  LightSpec left, right;
  left.position_m = {-1.9, 2.35, 2.0}, right.position_m = {1.9, 2.35, -2.0};
  const Lighting lighting = make_lighting({left, right}, RoomSpec{});
  for (const float albedo : {0.18f, 0.9f}) {
    std::vector<RaySurface> surfaces;
    surfaces.push_back(
        surface("card", grid_mesh({0.4, 0.85, 0}, {-0.8, 0, 0}, {0, 0.8, 0}, 0.1), Vector3f::Constant(albedo)));
    const RayScene scene(std::move(surfaces));
    Isometry3d world_from_camera = Isometry3d::Identity();  // 2.1 m before the card, 1.25 m high
    world_from_camera.linear() << -1, 0, 0, 0, -1, 0, 0, 0, 1;
    world_from_camera.translation() = Vector3d(0, 1.25, -2.1);
    FilmSpec film;
    film.gain = nominal_exposure(lighting);
    const cv::Mat image = render_color(scene, lighting, IndirectLight(scene, lighting), RayTable(color_camera()),
                                       world_from_camera, film, 1);
    const double level = cv::mean(image(cv::Rect(225, 123, 20, 20)))[1];
    if (albedo < 0.5f) {
      EXPECT_GT(level, 70);
      EXPECT_LT(level, 140);
    } else {
      EXPECT_GT(level, 150);
      EXPECT_LT(level, 251);
    }
  }
}

TEST(ColorCamera, SameBytesForAnyThreadCountAndSeedsDiffer) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(wall(Vector3f::Constant(0.6f)));
  surfaces.push_back(surface("ball", sphere_mesh({0.2, 0, 1.8}, 0.3, 40), Vector3f(0.2f, 0.3f, 0.6f)));
  surfaces.push_back(surface("mirror", sphere_mesh({-0.6, 0, 1.8}, 0.2, 40), Vector3f::Constant(0.8f)));
  surfaces.back().material.chrome = true;
  const RayScene scene(std::move(surfaces));
  cv::Mat images[2];
  for (int threads = 1; threads <= 2; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    images[threads - 1] = render(scene, color_camera());
  }
  EXPECT_EQ(cv::norm(images[0], images[1], cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(images[0], render(scene, color_camera(), {}, 2), cv::NORM_INF), 0);
}

// Seen through colour and infrared at the same place, labels and depth tell of the same things.
TEST(Labels, AgreeWithDepth) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(wall(Vector3f::Constant(0.6f)));
  surfaces.push_back(surface("top", sphere_mesh({-0.5, 0, 1.5}, 0.3, 60), Vector3f::Ones(), Label::top));
  surfaces.push_back(surface("bottom", sphere_mesh({0.5, 0, 2.0}, 0.3, 60), Vector3f::Ones(), Label::bottom));
  surfaces.push_back(surface("skin", sphere_mesh({0, 0.35, 1.0}, 0.1, 60), Vector3f::Ones(), Label::skin));
  const RayScene scene(std::move(surfaces));
  const Camera camera = color_camera();
  const RayTable rays(camera);
  const cv::Mat labels = render_labels(scene, rays, Isometry3d::Identity());
  const IrView view(scene, rays, camera, Isometry3d::Identity(), 0);
  const auto samples = view.first_hits();
  int counts[4] = {};
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels.at<std::uint8_t>(y, x);
      const float depth_m = samples[static_cast<std::size_t>(y) * labels.cols + x].depth_m;
      ++counts[label];
      if (label == 0) {
        ASSERT_NEAR(depth_m, 3, 1e-3);
      }
      if (label == 1) {
        ASSERT_LT(depth_m, 1.1);
      }
      if (label == 2) {
        ASSERT_TRUE(depth_m > 1.15 && depth_m < 1.55);
      }
      if (label == 3) {
        ASSERT_TRUE(depth_m > 1.65 && depth_m < 2.05);
      }
    }
  for (const int count : counts) EXPECT_GT(count, 300);
}

std::vector<SensorSpec> two_sensors() {
  std::vector<SensorSpec> rig(2);
  for (auto& sensor : rig) sensor.calibration.ir = Camera{512, 424, 366, 366, 256, 208, {0.09, -0.27, 0, 0, 0.1}};
  // k1 looks along -z from +z, k2 along +z from -z.
  rig[0].world_from_sensor.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  rig[0].world_from_sensor.translation() = Vector3d(0, 0, 2);
  rig[1].world_from_sensor.linear() << -1, 0, 0, 0, -1, 0, 0, 0, 1;
  rig[1].world_from_sensor.translation() = Vector3d(0, 0, -2);
  return rig;
}

TEST(Visibility, OuterSideFacingAndUnoccluded) {
  // A sheet that faces k1; a plate covers the half with x > 0 from k1.
  const Mesh sheet = grid_mesh({-0.4, -0.4, 0}, {0.8, 0, 0}, {0, 0.8, 0}, 0.02);
  std::vector<RaySurface> surfaces;
  surfaces.push_back(surface("sheet", sheet, Vector3f::Ones(), Label::top));
  surfaces.push_back(surface("plate", box_mesh({0, -1, 0.5}, {1, 1, 0.51}), Vector3f::Ones()));
  const RayScene scene(std::move(surfaces));
  const auto views = count_views(scene, sheet, two_sensors());
  for (std::size_t i = 0; i < sheet.vertices.size(); ++i) {
    if (sheet.vertices[i].x() < -0.01) {
      ASSERT_EQ(views[i], 1);
    }
    if (sheet.vertices[i].x() > 0.01) {
      ASSERT_EQ(views[i], 0);
    }
  }
}

TEST(Visibility, PartOfARimThatSomeSensorSees) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(surface("front plate", box_mesh({0, -1, 0.5}, {1, 1, 0.51}), Vector3f::Ones()));
  surfaces.push_back(surface("back plate", box_mesh({-2, -1, -0.51}, {2, 1, -0.5}), Vector3f::Ones()));
  const RayScene scene(std::move(surfaces));
  const std::vector<Vector3d> square{{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, 0}, {-0.2, 0.2, 0}};
  EXPECT_NEAR(visible_part(scene, square, two_sensors()), 0.5, 0.02);
}

}  // namespace
}  // namespace dressform
