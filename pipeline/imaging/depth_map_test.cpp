#include "pipeline/imaging/depth_map.h"

#include <gtest/gtest.h>

#include "pipeline/geometry/poisson.h"
#include "pipeline/testing/test_scene.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using test_scene::Figure;

SensorCalibration sensor(double offset_m = 0) { return test_scene::kinect(0.25, offset_m); }

cv::Mat depth_of(const Figure& figure, const SensorCalibration& calibration, double noise) {
  const Isometry3d pose = test_scene::looking_at({0, 1.15, 2}, {0, 0.95, 0});
  return test_scene::depth_image(figure, calibration, normalized_grid(calibration.ir), pose, noise, 5);
}

TEST(Projector, AgreesWithTheCamera) {
  const Camera camera = test_scene::kinect(1).ir;
  const Projector project(camera);
  for (int k = 0; k < 200; ++k) {
    const auto u = uniform4(1, 2, k);
    const Vector2d pixel(u[0] * (camera.width - 1), u[1] * (camera.height - 1));
    const Vector3d point = camera.unproject(pixel, 0.5 + 4 * u[2]);
    Vector2f found;
    ASSERT_TRUE(project(point.cast<float>(), found));
    EXPECT_LT((found.cast<double>() - pixel).norm(), 2e-3);
  }
  Vector2f pixel;
  EXPECT_FALSE(project({0, 0, -1}, pixel));
  EXPECT_FALSE(project({5, 0, 1}, pixel));
}

TEST(DepthMap, PlaneHasItsNormalAndDepth) {
  Figure wall;
  wall.floor = false;
  wall.wall_m = 1.0;
  const SensorCalibration calibration = sensor(-0.02);
  const Isometry3d pose = test_scene::looking_at({0, 0, 0.9}, {0, 0, -1});
  const cv::Mat image = test_scene::depth_image(wall, calibration, normalized_grid(calibration.ir), pose, 0, 1);
  const DepthMap map = make_depth_map(image, calibration, {});
  const int middle = map.camera.height / 2 * map.camera.width + map.camera.width / 2;
  EXPECT_NEAR(map.points[middle].z(), 1.9, 0.001);  // the offset is taken off
  EXPECT_GT(-map.normals[middle].z(), 0.999f);
  EXPECT_GT(map.valid, static_cast<int>(map.points.size()) / 3);
}

TEST(DepthMap, SphereNormalsPointOutwards) {
  Figure ball;
  ball.floor = false;
  ball.wall_m = 0;
  ball.parts = {{{0, 1, 0}, {.4, .4, .4}}};
  const SensorCalibration calibration = test_scene::kinect(0.5);
  const Isometry3d pose = test_scene::looking_at({0, 1, 2}, {0, 1, 0});
  const DepthMap map = make_depth_map(
      test_scene::depth_image(ball, calibration, normalized_grid(calibration.ir), pose, 0, 1), calibration, {});
  ASSERT_GT(map.valid, 1000);
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    if (!map.has_normal(static_cast<int>(i))) continue;
    const Vector3d outward = (pose * map.points[i].cast<double>() - Vector3d(0, 1, 0)).normalized();
    EXPECT_GT(outward.dot(pose.linear() * map.normals[i].cast<double>()), 0.97);
  }
}

TEST(DepthMap, FlyingPixelsAndEdgesAreDropped) {
  const SensorCalibration calibration = sensor();
  cv::Mat image = depth_of(test_scene::standing_figure(), calibration, 0);
  const int x = 64, y = 95;              // in front of the floor
  image.at<std::uint16_t>(y, x) = 1500;  // in mid air
  const cv::Mat clean = clean_depth(image, calibration, {});
  EXPECT_EQ(clean.at<float>(y, x), 0.0f);
  EXPECT_EQ(clean.at<float>(y, x + 1), 0.0f);
  EXPECT_GT(clean.at<float>(y, x + 3), 0.0f);
  EXPECT_EQ(image.at<std::uint16_t>(y, x), 1500);
}

TEST(DepthMap, EmptyAndWrongImages) {
  const SensorCalibration calibration = sensor();
  EXPECT_EQ(make_depth_map(cv::Mat(calibration.ir.height, calibration.ir.width, CV_16U, cv::Scalar(0)), calibration, {})
                .valid,
            0);
  EXPECT_THROW(make_depth_map(cv::Mat(), calibration, {}), InputError);
  EXPECT_THROW(make_depth_map(cv::Mat(8, 8, CV_16U, cv::Scalar(0)), calibration, {}), InputError);
}

TEST(PoissonSurface, SphereIsClosedAndRepeatable) {
  PointCloud ball;
  for (int i = 0; i < 4000; ++i) {
    const auto n = normal4(3, 4, i);
    ball.normals.push_back(Vector3d(n[0], n[1], n[2]).normalized());
    ball.points.push_back(0.5 * ball.normals.back());
  }
  const Mesh mesh = poisson_surface(ball, 6);
  EXPECT_TRUE(topology(mesh).closed());
  for (const auto& p : mesh.vertices) EXPECT_NEAR(p.norm(), 0.5, 0.01);
  double volume = 0;  // positive: outward
  for (const auto& t : mesh.triangles)
    volume += mesh.vertices[t[0]].cross(mesh.vertices[t[1]]).dot(mesh.vertices[t[2]]) / 6;
  EXPECT_NEAR(volume, 4 * M_PI / 3 * 0.125, 0.01);
  EXPECT_EQ(poisson_surface(ball, 6).vertices, mesh.vertices);
  EXPECT_TRUE(poisson_surface({}, 6).triangles.empty());
}

}  // namespace
}  // namespace dressform
