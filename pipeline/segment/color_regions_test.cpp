#include "pipeline/segment/color_regions.h"

#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "scenes/random.h"

namespace dressform {
namespace {

TEST(PiecesOfKeys, GivesSpecksToWhatIsRoundThemAndKeepsIslands) {
  cv::Mat keys = cv::Mat::zeros(10, 20, CV_32S);
  keys.colRange(0, 8).setTo(1);
  keys.colRange(8, 15).setTo(2);
  keys.at<int>(4, 3) = 2;   // a speck of the other class
  keys.at<int>(9, 19) = 1;  // by itself, too small
  const LabelMap found = pieces_of_keys(keys, 5);
  EXPECT_EQ(found.count, 3);
  EXPECT_EQ(found.labels.at<int>(4, 3), found.labels.at<int>(0, 0));
  EXPECT_NE(found.labels.at<int>(0, 0), found.labels.at<int>(0, 10));
  EXPECT_EQ(found.labels.at<int>(9, 19), 3);
  EXPECT_EQ(found.labels.at<int>(0, 17), 0);
}

// Three bands of plain cloth with a camera's noise; the mask leaves the frame out.
struct Bands {
  cv::Mat bgr = cv::Mat(90, 120, CV_8UC3), mask = cv::Mat::zeros(90, 120, CV_8U), band = cv::Mat(90, 120, CV_32S);
};
Bands make_bands() {
  const cv::Vec3b colors[] = {{150, 60, 30}, {60, 150, 60}, {170, 190, 220}};
  Bands made;
  for (int y = 0; y < made.bgr.rows; ++y)
    for (int x = 0; x < made.bgr.cols; ++x) {
      const auto noise = normal4(3, 1, static_cast<std::uint64_t>(y) * made.bgr.cols + x);
      made.band.at<int>(y, x) = x / 40;
      for (int c = 0; c < 3; ++c)
        made.bgr.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(colors[x / 40][c] + 3 * noise[c]);
    }
  made.mask(cv::Rect(5, 5, 110, 80)) = 255;
  return made;
}

using Find = std::function<LabelMap(const cv::Mat&, const cv::Mat&, double)>;
struct Case {
  const char* name;
  Find find;
};
class EveryColorRegions : public testing::TestWithParam<Case> {};

TEST_P(EveryColorRegions, ThreeBandsAreThreeRegions) {
  const Bands bands = make_bands();
  const LabelMap found = GetParam().find(bands.bgr, bands.mask, 0.25);
  ASSERT_EQ(found.count, 3);
  int wrong = 0;
  for (int y = 0; y < bands.mask.rows; ++y)
    for (int x = 0; x < bands.mask.cols; ++x) {
      const int label = found.labels.at<int>(y, x);
      ASSERT_EQ(label != 0, bands.mask.at<uchar>(y, x) != 0) << x << " " << y;
      wrong += label != 0 && label != bands.band.at<int>(y, x) + 1;  // numbered in reading order
    }
  EXPECT_LT(wrong, 0.02 * cv::countNonZero(bands.mask));
  const LabelMap again = GetParam().find(bands.bgr, bands.mask, 0.25);
  EXPECT_EQ(cv::norm(found.labels, again.labels, cv::NORM_INF), 0);
}

TEST_P(EveryColorRegions, NothingToLookAtIsNoRegion) {
  const Bands bands = make_bands();
  const LabelMap found = GetParam().find(bands.bgr, cv::Mat::zeros(bands.mask.size(), CV_8U), 0.25);
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(cv::countNonZero(found.labels), 0);
}

// As many clusters as colours for k-means, which splits noise where it has more to give; the others find how many.
LabelMap three_means(const cv::Mat& bgr, const cv::Mat& mask, double scale) {
  KmeansParams params;
  params.clusters = 3;
  return kmeans_regions(bgr, mask, scale, params, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, EveryColorRegions,
    testing::Values(Case{"mean_shift", [](const cv::Mat& bgr, const cv::Mat& mask,
                                          double scale) { return mean_shift_regions(bgr, mask, scale, {}); }},
                    Case{"kmeans", three_means},
                    Case{"gla_mrf", [](const cv::Mat& bgr, const cv::Mat& mask,
                                       double scale) { return gla_mrf_regions(bgr, mask, scale, {}); }}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace dressform
