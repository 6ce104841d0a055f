#include "eval/gate/power/fault_shapes.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "eval/testing/test_meshes.h"

namespace dressform {
namespace {

const Placement kPlace(3, "test.fault");

Mesh can() { return test_meshes::tube(0.1, 0.1, {0, 0, 0}, 0, 1, 48, 20, false); }

TEST(FaultShapes, BlowMovesEveryVertexOfATubeOutwardsByThatMuch) {
  Mesh mesh = can();
  blow(mesh, 0.004);
  for (const auto& vertex : mesh.vertices) EXPECT_NEAR(std::hypot(vertex.x(), vertex.z()), 0.104, 1e-4);
}

TEST(FaultShapes, ScaleAndTurnKeepTheCentre) {
  Mesh mesh = can();
  scale_about_centre(mesh, 1.1);
  EXPECT_NEAR(mesh.vertices.front().y(), 0.5 - 0.55, 1e-12);
  mesh = can();
  turn_about_centre(mesh, 180, Vector3d::UnitX());
  EXPECT_NEAR(mesh.vertices.front().y(), 1, 1e-12) << "the lower rim is the upper one";
}

TEST(FaultShapes, ShakeHasTheSpreadThatItIsGiven) {
  Mesh mesh = can();
  const Mesh before = mesh;
  shake(mesh, 0.002, kPlace);
  double sum = 0;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
    sum += (mesh.vertices[k] - before.vertices[k]).squaredNorm() / 3;
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(mesh.vertices.size())), 0.002, 0.0001);
}

TEST(FaultShapes, ADentIsDeepestAtItsSpotAndEndsAtItsRadius) {
  Mesh mesh = can();
  const Mesh before = mesh;
  dent(mesh, 0.05, 0.01, kPlace);
  double deepest = 0;
  int moved = 0;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    const double by = (mesh.vertices[k] - before.vertices[k]).norm();
    deepest = std::max(deepest, by);
    moved += by > 0;
  }
  EXPECT_NEAR(deepest, 0.01, 1e-9);
  EXPECT_GT(moved, 1);
  EXPECT_LT(moved, static_cast<int>(mesh.vertices.size()) / 4);
}

TEST(FaultShapes, TrianglesAtASpotLieTogether) {
  const Mesh mesh = can();
  const auto found = triangles_at_a_spot(mesh, 0.08, kPlace);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found.size(), mesh.triangles.size() / 2);
  EXPECT_EQ(found, triangles_at_a_spot(mesh, 0.08, kPlace)) << "the same placement, the same spot";
}

TEST(FaultShapes, ImagesMoveBrightenAndGrowByWhatIsSaid) {
  cv::Mat image = cv::Mat::zeros(20, 20, CV_8UC1);
  image.at<unsigned char>(10, 8) = 200;
  cv::Mat moved = image.clone();
  shift_image(moved, 3, 2);
  EXPECT_EQ(moved.at<unsigned char>(12, 11), 200);
  EXPECT_EQ(cv::countNonZero(moved), 1);
  cv::Mat grown = image.clone();
  grow_mask(grown, 2);
  EXPECT_EQ(grown.at<unsigned char>(10, 10), 200);
  EXPECT_EQ(grown.at<unsigned char>(10, 11), 0);
  grow_mask(grown, -2);
  EXPECT_EQ(cv::countNonZero(grown), 1);
  add_levels(image, 100);
  EXPECT_EQ(image.at<unsigned char>(10, 8), 255) << "held within the type";
  EXPECT_EQ(image.at<unsigned char>(0, 0), 100);
  multiply_image(image, 0.5);
  EXPECT_EQ(image.at<unsigned char>(0, 0), 50);
}

TEST(FaultShapes, AHoleHasItsSizeAndLiesInside) {
  for (Seed seed = 1; seed < 20; ++seed) {
    cv::Mat image = cv::Mat::zeros(40, 60, CV_8UC3);
    square_hole(image, 8, cv::Scalar::all(9), Placement(seed, "test.hole"));
    EXPECT_EQ(cv::countNonZero(image.reshape(1)), 8 * 8 * 3) << seed;
  }
}

TEST(Placement, IsDrawnFromItsSeedAndTheFaultsName) {
  EXPECT_EQ(Placement(1, "a").uniform(0), Placement(1, "a").uniform(0));
  EXPECT_NE(Placement(1, "a").uniform(0), Placement(2, "a").uniform(0));
  EXPECT_NE(Placement(1, "a").uniform(0), Placement(1, "b").uniform(0));
  EXPECT_NEAR(Placement(1, "a").direction(4).norm(), 1, 1e-12);
  EXPECT_EQ(Placement(1, "a").one_of(std::map<std::string, int>{}), "");
  EXPECT_EQ(Placement(1, "a").one_of(std::map<std::string, int>{{"k1", 0}}), "k1");
}

}  // namespace
}  // namespace dressform
