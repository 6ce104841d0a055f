#include "pipeline/texture/texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/texture/textured_tube.h"
#include "scenes/random.h"

namespace dressform {
namespace {

TexturedGarments run(const TubeScene& scene, const std::string& variant = "levelled", const FieldValues& values = {}) {
  return Texture::at(variant).run(scene.session, scene.calibration, scene.naked, scene.registration, scene.filled,
                                  scene.opened, values, 1);
}

cv::Vec3f checks(double turn, double height) {
  const bool odd = (static_cast<int>(std::floor(turn * 0.2 / 0.05)) + static_cast<int>(std::floor(height / 0.05))) & 1;
  return odd ? cv::Vec3f(60, 70, 180) : cv::Vec3f(190, 170, 150);
}

cv::Vec3f plain(double, double) { return {90, 120, 150}; }

// Calls visit(turn, height, colour found) for points spread over the garment.
template <class Visit>
void for_each_sample(const TexturedMesh& garment, const Visit& visit) {
  for (std::size_t i = 0; i < garment.mesh.triangles.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      const auto u = uniform4(7, 1, 4 * i + k);
      const double root = std::sqrt(u[0]);
      const Vector3d weights(1 - root, root * (1 - u[1]), root * u[1]);
      Vector3d point = Vector3d::Zero();
      Vector2f uv = Vector2f::Zero();
      for (int c = 0; c < 3; ++c) {
        point += weights[c] * garment.mesh.vertices[garment.mesh.triangles[i][c]];
        uv += static_cast<float>(weights[c]) * garment.corner_uv[i][c];
      }
      cv::Mat patch;
      cv::getRectSubPix(garment.texture, {1, 1},
                        {uv.x() * garment.texture.cols - 0.5f, uv.y() * garment.texture.rows - 0.5f}, patch);
      visit(std::atan2(point.x(), point.z()), point.y(), patch.at<cv::Vec3b>(0, 0));
    }
}

double psnr(const TexturedMesh& garment, const TubeScene::Print& print) {
  double sum = 0;
  int count = 0;
  for_each_sample(garment, [&](double turn, double height, const cv::Vec3b& found) {
    const cv::Vec3f expected = print(turn, height);
    for (int c = 0; c < 3; ++c) sum += (expected[c] - found[c]) * (expected[c] - found[c]);
    count += 3;
  });
  return 10 * std::log10(255.0 * 255.0 * count / sum);
}

class EveryVariant : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Texture, EveryVariant, testing::ValuesIn(Texture::automatic_names()),
                         [](const auto& info) { return info.param; });

TEST_P(EveryVariant, BringsBackTheCheckedTube) {
  const TubeScene scene = tube_scene(checks);
  const TexturedGarments result = run(scene, GetParam());
  const TexturedMesh& top = result.garments.at("top");
  EXPECT_EQ(top.mesh.vertices.size(), scene.opened.garments.at("top").mesh.vertices.size());
  EXPECT_EQ(top.mesh.triangles, scene.opened.garments.at("top").mesh.triangles);
  ASSERT_EQ(top.corner_uv.size(), top.mesh.triangles.size());
  ASSERT_EQ(top.texture.type(), CV_8UC3);
  // Edges of checks are blurred by the pixels; colours at vertices by the mesh, whose triangles are a third of a check.
  EXPECT_GT(psnr(top, checks), GetParam() == "vertex_colors" ? 14 : 18);
  EXPECT_LT(result.unseen_part.at("top"), 0.03);
}

TEST_P(EveryVariant, SameBytesForOneAndTwoThreads) {
  const TubeScene scene = tube_scene(checks, 0.25);
  std::vector<std::string> bytes;
  for (const int threads : {1, 2, 2}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const TexturedMesh top = run(scene, GetParam()).garments.at("top");
    bytes.emplace_back(reinterpret_cast<const char*>(top.texture.data), top.texture.total() * 3);
    bytes.back().append(reinterpret_cast<const char*>(top.corner_uv.data()), top.corner_uv.size() * 24);
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_EQ(bytes[1], bytes[2]);
}

TEST_P(EveryVariant, NoViewGivesPlainGreyAndSaysSo) {
  TubeScene scene = tube_scene(checks, 0.1);
  scene.registration.model_from_sensor.clear();
  const TexturedGarments result = run(scene, GetParam());
  EXPECT_EQ(result.unseen_part.at("top"), 1);
  const TexturedMesh& top = result.garments.at("top");
  ASSERT_FALSE(top.texture.empty());
  EXPECT_EQ(cv::norm(top.texture, cv::Mat(top.texture.size(), CV_8UC3, cv::Scalar::all(128)), cv::NORM_INF), 0);
}

TEST_P(EveryVariant, GarmentWithoutTrianglesHasATexture) {
  TubeScene scene = tube_scene(checks, 0.1);
  scene.opened.garments["top"].mesh = {};
  const TexturedGarments result = run(scene, GetParam());
  EXPECT_TRUE(result.garments.at("top").corner_uv.empty());
  EXPECT_FALSE(result.garments.at("top").texture.empty());
}

TEST_P(EveryVariant, NoTriangleIsMirroredOrOutside) {
  const TexturedMesh top = run(tube_scene(checks, 0.25), GetParam()).garments.at("top");
  for (const auto& uv : top.corner_uv) {
    const Vector2f b = uv[1] - uv[0], c = uv[2] - uv[0];
    EXPECT_LT(b.x() * c.y() - b.y() * c.x(), 0);  // counter-clockwise with v down
    for (const Vector2f& corner : uv) {
      EXPECT_GT(corner.minCoeff(), 0);
      EXPECT_LT(corner.maxCoeff(), 1);
    }
  }
}

TEST(TextureLevelled, IsSharp) { EXPECT_GT(psnr(run(tube_scene(checks, 0.5)).garments.at("top"), checks), 21); }

// Fringes of colour over even luma, as demosaicing leaves them in fine cloth.
TEST(TextureLevelled, ColourFringesGoAndTheColourBesideTheGarmentStaysOut) {
  const auto fringes = [](double turn, double) -> cv::Vec3f {
    const float swing = static_cast<int>(std::floor(turn * 0.2 / 0.004)) % 2 ? 30.f : -30.f;
    return {120 + swing, 120 - 0.114f / 0.587f * swing, 120};
  };
  const auto even = [](double, double) -> cv::Vec3f { return {120, 120, 120}; };
  const TexturedMesh top = run(tube_scene(fringes, 0.5)).garments.at("top");
  EXPECT_GT(psnr(top, even), psnr(top, fringes) + 2);
}

TEST(TextureLevelled, WrittenTextStaysReadable) {
  cv::Mat page(200, 600, CV_8UC3, cv::Scalar::all(230));
  cv::putText(page, "FRONT 27", {20, 140}, cv::FONT_HERSHEY_SIMPLEX, 3.4, cv::Scalar(20, 20, 120), 14, cv::LINE_AA);
  const auto print = [&](double turn, double height) -> cv::Vec3f {
    const double x = turn * 0.2 / 0.0006 + 300, y = (1.25 - height) / 0.0006 + 100;
    if (x < 0 || y < 0 || x >= 600 || y >= 200) return {230, 230, 230};
    return page.at<cv::Vec3b>(static_cast<int>(y), static_cast<int>(x));
  };
  const auto mirrored = [&](double turn, double height) { return print(-turn, height); };
  const TexturedMesh top = run(tube_scene(print, 0.5)).garments.at("top");
  EXPECT_GT(psnr(top, print), psnr(top, mirrored) + 5);
}

TEST(TextureLevelled, LevelsOneViewExposedByOneStop) {
  const TexturedMesh top = run(tube_scene(plain, 0.25, {0.5, 1, 1, 1})).garments.at("top");
  double low = 255, high = 0;
  for_each_sample(top, [&](double, double, const cv::Vec3b& found) {
    low = std::min<double>(low, found[1]);
    high = std::max<double>(high, found[1]);
  });
  EXPECT_LT(high - low, 6);  // 34 levels apart as photographed
}

TEST(TextureLevelled, MeanExposureIsKept) {
  const TexturedMesh top = run(tube_scene(plain, 0.25)).garments.at("top");
  for_each_sample(top, [&](double, double, const cv::Vec3b& found) { ASSERT_NEAR(found[1], 120, 2); });
}

TEST(TextureLevelled, WhatHidesTheGarmentDoesNotBleedIn) {
  Mesh arm = tube(0.04, 0.95, 1.45, 24, 4);
  for (Vector3d& v : arm.vertices) v += Vector3d(0.05, 0, 0.32);  // in front of k1
  const TubeScene scene = tube_scene(plain, 0.4, {}, arm);
  const TexturedGarments result = run(scene);
  for_each_sample(result.garments.at("top"), [&](double turn, double height, const cv::Vec3b& found) {
    ASSERT_NEAR(found[0], 90, 10) << turn << " " << height;
    ASSERT_NEAR(found[1], 120, 10) << turn << " " << height;
    ASSERT_NEAR(found[2], 150, 10) << turn << " " << height;
  });
  EXPECT_GT(result.unseen_part.at("top"), 0.01);
}

TEST(TextureLevelled, OccluderIsKeptOutEvenWhereTheMaskIsWrong) {
  Mesh arm = tube(0.04, 0.95, 1.45, 24, 4);
  for (Vector3d& v : arm.vertices) v += Vector3d(0.05, 0, 0.32);
  TubeScene scene = tube_scene(plain, 0.4, {}, arm);
  cv::Mat& mask = scene.filled.garments["top"]["k1"].mask;
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::Mat::ones(81, 81, CV_8UC1));
  for_each_sample(run(scene).garments.at("top"), [&](double turn, double height, const cv::Vec3b& found) {
    ASSERT_NEAR(found[1], 120, 12) << turn << " " << height;
  });
}

TEST(TextureLevelled, FilledInColoursAreUsedWhereNothingElseIsIfAsked) {
  TubeScene scene = tube_scene(plain, 0.25);
  FilledGarment& front = scene.filled.garments["top"]["k1"];
  cv::Mat seen = front.mask > 0;
  front.mask.setTo(128, seen);
  front.color.setTo(cv::Scalar(40, 40, 40), seen);
  for (const char* name : {"k2", "k3", "k4"}) scene.registration.model_from_sensor.erase(name);
  double nearest = 255;
  for_each_sample(run(scene, "levelled", {{"filled_trust", 0.05}}).garments.at("top"),
                  [&](double turn, double, const cv::Vec3b& found) {
                    if (std::abs(turn) < 0.5) nearest = std::min<double>(nearest, std::abs(found[1] - 40.0));
                  });
  EXPECT_LT(nearest, 3);
}

TEST(TextureLevelled, FilledInColoursAreNotTrustedUnasked) {
  TubeScene scene = tube_scene(plain, 0.4);
  FilledGarment& front = scene.filled.garments["top"]["k1"];
  const cv::Rect strip(front.mask.cols / 2 - 12, 0, 24, front.mask.rows);  // as behind an arm, with its colour
  cv::Mat seen = front.mask(strip) > 0;
  front.mask(strip).setTo(128, seen);
  front.color(strip).setTo(cv::Scalar(130, 160, 230));
  for_each_sample(run(scene).garments.at("top"),
                  [&](double, double, const cv::Vec3b& found) { ASSERT_NEAR(found[2], 150, 4); });
}

TEST(TextureLevelled, AMissingViewLeavesAPartUnseenWithTheColourAround) {
  TubeScene scene = tube_scene(plain, 0.25);
  scene.registration.model_from_sensor.erase("k3");
  scene.registration.model_from_sensor.erase("k4");
  const TexturedGarments result = run(scene);
  EXPECT_NEAR(result.unseen_part.at("top"), 0.35, 0.12);
  for_each_sample(result.garments.at("top"),
                  [&](double, double, const cv::Vec3b& found) { ASSERT_NEAR(found[1], 120, 4); });
}

TEST(TextureLevelled, SmallLargestSizeIsKept) {
  const TexturedMesh top = run(tube_scene(checks, 0.25), "levelled", {{"largest_px", 128}}).garments.at("top");
  EXPECT_LE(std::max(top.texture.cols, top.texture.rows), 128);
}

}  // namespace
}  // namespace dressform
