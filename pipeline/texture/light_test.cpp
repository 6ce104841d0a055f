#include "pipeline/texture/light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/texture/gains.h"
#include "pipeline/texture/textured_tube.h"

namespace dressform {
namespace {

// Irradiance of a lamp on one side and of light from everywhere.
double irradiance(double turn) { return 0.65 + 0.35 * std::cos(turn - 0.6); }

cv::Vec3f lit(const cv::Vec3f& color, double turn) {
  const auto gain = static_cast<float>(irradiance(turn));
  return {with_gain(color[0], gain), with_gain(color[1], gain), with_gain(color[2], gain)};
}

cv::Vec3f lit_grey(double turn, double) { return lit({170, 180, 190}, turn); }

// The tube of the texture tests over a naked tube of `skin`, which four cameras of unlike exposure photographed.
TubeScene dressed_and_naked(const TubeScene::Print& cloth, const TubeScene::Print& skin) {
  const Mesh body = tube(0.18, 0.3, 1.7, 72, 60);
  TubeScene scene = tube_scene(cloth, 0.25, {}, body);
  const double exposures[] = {1, 0.8, 0.9, 0.7};
  for (int i = 0; i < 4; ++i) {
    const std::string& name = scene.session.sensors[i];
    const SensorCalibration& sensor = scene.calibration.sensors.at(name);
    const Isometry3d model_from_color = scene.registration.model_from_sensor.at(name) * sensor.color_from_ir.inverse();
    scene.session.naked[name].color =
        photograph(*sensor.color, model_from_color, MeshQuery(body), MeshQuery(Mesh{}), skin, exposures[i]).color;
  }
  return scene;
}

std::optional<Light> light_of(const TubeScene& scene) {
  return light_on(scene.naked, scene.session.naked, scene.calibration, scene.registration);
}

TEST(Light, IsReadOffTheNakedBody) {
  const auto light = light_of(dressed_and_naked(lit_grey, lit_grey));
  ASSERT_TRUE(light);
  const auto log_at = [&](double turn) {
    return light->log_irradiance({0, 1.1, 0}, {std::sin(turn), 0, std::cos(turn)})[1];
  };
  for (double turn = -3; turn < 3; turn += 0.5)
    EXPECT_NEAR(log_at(turn) - log_at(0.6), std::log(irradiance(turn) / irradiance(0.6)), 0.04) << turn;
}

TEST(Light, NoneFromABodyOfTwoColours) {
  const auto painted = [](double turn, double height) {
    return std::sin(8 * turn) * std::sin(20 * height) > 0 ? cv::Vec3f(40, 60, 120) : cv::Vec3f(200, 190, 180);
  };
  EXPECT_FALSE(light_of(dressed_and_naked(lit_grey, painted)));
}

TEST(Light, NoneWithoutNakedImages) {
  TubeScene scene = dressed_and_naked(lit_grey, lit_grey);
  for (auto& [name, shot] : scene.session.naked) shot.color = cv::Mat();
  EXPECT_FALSE(light_of(scene));
  scene.session.naked.clear();
  EXPECT_FALSE(light_of(scene));
  scene.naked.body = {};
  EXPECT_FALSE(light_of(scene));
}

TEST(Light, IsTakenOffTheCloth) {
  const TubeScene scene = dressed_and_naked(lit_grey, lit_grey);
  const auto spread = [&](double part) {
    const auto result = Texture::at("levelled")
                            .run(scene.session, scene.calibration, scene.naked, scene.registration, scene.filled,
                                 scene.opened, {{"unlit", part}}, 1);
    cv::Scalar mean, deviation;
    cv::meanStdDev(result.garments.at("top").texture, mean, deviation);
    return deviation[1];
  };
  const double with_light = spread(0), without = spread(1);
  EXPECT_GT(with_light, 15);
  EXPECT_LT(without, with_light / 4);
}

TEST(Light, GainsAverageToOne) {
  Light::Coefficients coefficients = Light::Coefficients::Constant(0.1);
  const Mesh mesh = tube(0.2, 0.9, 1.5, 24, 6);
  const Eigen::MatrixXf gains = unlit_gains(Light(coefficients), mesh, 1);
  ASSERT_EQ(gains.rows(), static_cast<Eigen::Index>(mesh.vertices.size()));
  EXPECT_NEAR(gains.array().log().mean(), 0, 1e-5);
  EXPECT_GT(gains.maxCoeff(), 1.05f);
  EXPECT_EQ(unlit_gains(Light(coefficients), mesh, 0), Eigen::MatrixXf::Ones(gains.rows(), 3));
  EXPECT_EQ(unlit_gains(Light(coefficients), Mesh{}, 1).rows(), 0);
}

}  // namespace
}  // namespace dressform
