#include "eval/gate/picture_difference.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/gate/golden_case.h"

namespace dressform {
namespace {

// Cloth of two colours on white, as small as the gate's pictures.
cv::Mat some_picture() {
  cv::Mat image(220, 160, CV_8UC3, cv::Scalar::all(255));
  cv::rectangle(image, cv::Rect(40, 40, 80, 90), cv::Scalar(60, 90, 140), cv::FILLED);
  cv::rectangle(image, cv::Rect(50, 130, 60, 70), cv::Scalar(120, 80, 50), cv::FILLED);
  return image;
}

cv::Mat with_hole(int x, int y, int side) {
  cv::Mat image = some_picture();
  cv::rectangle(image, cv::Rect(x, y, side, side), cv::Scalar(186, 204, 219), cv::FILLED);  // the body's colour
  return image;
}

TEST(PictureDifference, EqualPicturesDoNotDiffer) {
  const auto same = picture_difference(some_picture(), some_picture());
  EXPECT_EQ(same.mean_levels, 0);
  EXPECT_EQ(same.worst_tile_levels, 0);
  EXPECT_EQ(same.flip, 0);
  EXPECT_EQ(PictureTolerance().excess(same), 0);
}

// A hole of 8 x 8 pixels in the cloth: (|186-60| + |204-90| + |219-140|) / 3 levels over 64 of 35200 pixels, and over
// 64 of the 256 of the tile round it, wherever it lies.
TEST(PictureDifference, AnEightPixelHoleFailsWhereverItLies) {
  for (const int x : {41, 47, 53, 60, 111})
    for (const int y : {44, 67, 101}) {
      const auto hole = picture_difference(some_picture(), with_hole(x, y, 8));
      EXPECT_NEAR(hole.mean_levels, (126 + 114 + 79) / 3.0 * 64 / (220 * 160), 1e-9);
      EXPECT_NEAR(hole.worst_tile_levels, (126 + 114 + 79) / 3.0 * 64 / 256, 1e-9);
      EXPECT_LE(hole.tile_x, x);
      EXPECT_GE(hole.tile_x + 16, x + 8);
      EXPECT_LT(hole.mean_levels, PictureTolerance().mean_levels) << "the mean alone would let it pass";
      EXPECT_GT(PictureTolerance().excess(hole), 1);
    }
}

TEST(PictureDifference, OneLevelOnEveryPixelOfAnEdgePasses) {
  cv::Mat soft = some_picture();
  for (int y = 40; y < 130; ++y) soft.at<cv::Vec3b>(y, 40) = cv::Vec3b(68, 96, 145);
  EXPECT_LT(PictureTolerance().excess(picture_difference(some_picture(), soft)), 1);
}

TEST(PictureDifference, IsSymmetricAndWorksOnPicturesSmallerThanATile) {
  const auto there = picture_difference(some_picture(), with_hole(60, 60, 8)),
             back = picture_difference(with_hole(60, 60, 8), some_picture());
  EXPECT_EQ(there.worst_tile_levels, back.worst_tile_levels);
  EXPECT_EQ(there.flip, back.flip);
  const cv::Mat dark(10, 9, CV_8UC3, cv::Scalar::all(50)), light(10, 9, CV_8UC3, cv::Scalar::all(60));
  EXPECT_NEAR(picture_difference(dark, light).worst_tile_levels, 10, 1e-9);
}

TEST(PictureDifference, AnotherSizeIsAnotherPicture) {
  const auto other = picture_difference(some_picture(), cv::Mat(220, 161, CV_8UC3, cv::Scalar::all(255)));
  EXPECT_FALSE(other.comparable);
  EXPECT_GT(PictureTolerance().excess(other), 1e9);
}

// References that cannot be told apart gate nothing.
TEST(PictureDifference, EveryTwoGoldensAreToldApart) {
  std::vector<std::pair<std::string, cv::Mat>> all;
  const std::filesystem::path golden = std::filesystem::path(DRESSFORM_SOURCE_DIR) / "golden";
  for (const auto& name : golden_case_names(golden))
    for (const auto& [stem, image] : read_golden_case(golden, name).images) all.emplace_back(name + "/" + stem, image);
  ASSERT_GE(all.size(), 8u);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      EXPECT_TRUE(told_apart(all[i].second, all[j].second)) << all[i].first << " and " << all[j].first;
}

}  // namespace
}  // namespace dressform
