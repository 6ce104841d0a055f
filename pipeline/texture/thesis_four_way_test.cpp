#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/texture/picked_parts.h"
#include "pipeline/texture/textured_tube.h"
#include "scenes/error.h"
#include "scenes/picks.h"

namespace dressform {
namespace {

cv::Vec3f quarters(double turn, double) {
  const int quarter = static_cast<int>(std::floor((turn + M_PI / 4) / (M_PI / 2)));
  return cv::Vec3f(90.f + 20.f * ((quarter + 4) % 4), 120, 150);
}

// Four upright borders, each 30 degrees further round than half way between two sensors, as a person saw fit.
constexpr double kOff = M_PI / 6;
Picks borders() {
  Picks picks;
  for (int i = 0; i < 4; ++i) {
    PickedPoints border{"model", {}};
    const double turn = M_PI / 4 + i * M_PI / 2 + kOff;
    for (int k = 0; k <= 20; ++k)
      border.points.push_back({0.2 * std::sin(turn), 1.48 - 0.56 * k / 20, 0.2 * std::cos(turn)});
    picks.points["border_top_" + std::to_string(i)].push_back(border);
  }
  return picks;
}

TexturedGarments run(const TubeScene& scene, const Picks& picks, const FieldValues& values = {}) {
  return Texture::at("thesis_four_way")
      .run_with_picks(scene.session, scene.calibration, scene.naked, scene.registration, scene.filled, scene.opened,
                      values, picks, 1);
}

struct Sample {
  double turn, height;
  cv::Vec3b color;
  Vector2f uv;
};
std::vector<Sample> middles(const TexturedMesh& garment) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < garment.mesh.triangles.size(); ++i) {
    Vector3d p = Vector3d::Zero();
    Vector2f uv = Vector2f::Zero();
    for (int k = 0; k < 3; ++k) {
      p += garment.mesh.vertices[garment.mesh.triangles[i][k]] / 3;
      uv += garment.corner_uv[i][k] / 3;
    }
    cv::Mat patch;
    cv::getRectSubPix(garment.texture, {1, 1},
                      {uv.x() * garment.texture.cols - 0.5f, uv.y() * garment.texture.rows - 0.5f}, patch);
    samples.push_back({std::atan2(p.x(), p.z()), p.y(), patch.at<cv::Vec3b>(0, 0), uv});
  }
  return samples;
}

TEST(ThesisFourWay, EachPartLiesInItsOwnPhotographOfFourSideBySide) {
  const TubeScene scene = tube_scene(quarters);
  const TexturedGarments result = run(scene, borders());
  const TexturedMesh& top = result.garments.at("top");
  EXPECT_EQ(top.mesh.triangles, scene.opened.garments.at("top").mesh.triangles);
  EXPECT_GT(top.texture.cols, 3 * top.texture.rows / 2);
  EXPECT_LT(result.unseen_part.at("top"), 0.12);  // 30 degrees of a quarter are seen at more than 75 degrees
  int wrong = 0;
  for (const Sample& s : middles(top)) {
    EXPECT_GE(s.uv.minCoeff(), 0);
    EXPECT_LE(s.uv.maxCoeff(), 1);
    const double round = s.turn - kOff + M_PI / 4 + 2 * M_PI;  // 0 where the first part begins
    const int part = static_cast<int>(std::floor(round / (M_PI / 2))) % 4;
    const double within = std::remainder(round, M_PI / 2) * 0.2;  // metres from the nearest border
    if (std::abs(within) > 0.03) wrong += static_cast<int>(s.uv.x() * 4) != part;
    const double off_edge = std::remainder(s.turn - M_PI / 4, M_PI / 2) * 0.2;
    const double facing = std::cos(std::remainder(s.turn - part * M_PI / 2, 2 * M_PI));
    const bool at_rim =
        std::abs(s.height - 1.2) > 0.28;  // outlines are made of what is within them, edges of print too
    if (std::abs(within) < 0.03 || std::abs(off_edge) < 0.015 || facing < 0.4 || at_rim) continue;
    EXPECT_NEAR(s.color[0], quarters(s.turn, 0)[0], 4) << s.turn << " " << s.height;
    EXPECT_NEAR(s.color[1], 120, 4);
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ThesisFourWay, ExposureIsEvenedOut) {
  const auto grey = [](double, double) { return cv::Vec3f(100, 100, 100); };
  const TexturedMesh top = run(tube_scene(grey, 0.4, {1, 1.6, 0.8, 1.2}), borders()).garments.at("top");
  int least = 255, most = 0;
  for (const Sample& s : middles(top)) {
    if (std::abs(std::remainder(s.turn - kOff - M_PI / 4, M_PI / 2)) < 0.15 || std::abs(s.height - 1.2) > 0.25)
      continue;
    least = std::min<int>(least, s.color[1]);
    most = std::max<int>(most, s.color[1]);
  }
  EXPECT_LT(most - least, 8);
}

TEST(ThesisFourWay, BordersThatStopShortStillPart) {
  Picks picks = borders();
  for (auto& [name, parts] : picks.points) {
    auto& points = parts[0].points;
    points = {points[1], points[10], points[19]};  // 50 mm from the rims
  }
  const auto result = run(tube_scene(quarters, 0.25), picks, {{"to_rim_m", 0.07}});
  EXPECT_LT(result.unseen_part.at("top"), 0.12);
}

TEST(ThesisFourWay, LargestSizeMissingViewsAndMissingBorders) {
  TubeScene scene = tube_scene(quarters, 0.25);
  const auto small = run(scene, borders(), {{"largest_px", 100}}).garments.at("top").texture;
  EXPECT_LE(std::max(small.cols, small.rows), 100);
  EXPECT_THROW(run(scene, {}), InputError);
  scene.registration.model_from_sensor.erase("k3");
  EXPECT_GT(run(scene, borders()).unseen_part.at("top"), 0.1);
  scene.registration.model_from_sensor.clear();
  const auto none = run(scene, borders());
  EXPECT_EQ(none.unseen_part.at("top"), 1);
  EXPECT_EQ(none.garments.at("top").texture.at<cv::Vec3b>(0, 0), cv::Vec3b(128, 128, 128));
  scene.opened.garments["top"].mesh = {};
  EXPECT_TRUE(run(scene, borders()).garments.at("top").corner_uv.empty());
}

}  // namespace
}  // namespace dressform
