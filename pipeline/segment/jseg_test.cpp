#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/segment/jseg_colors.h"
#include "pipeline/segment/jseg_growing.h"
#include "pipeline/segment/jseg_merging.h"
#include "pipeline/segment/jseg_regions.h"
#include "pipeline/segment/jseg_texture.h"
#include "pipeline/testing/texture_mosaic.h"
#include "scenes/error.h"
#include "scenes/random.h"

namespace dressform {
namespace {

using testing_images::boundary_f;
using testing_images::texture_mosaic;

cv::Mat all_of(const cv::Size& size) { return cv::Mat(size, CV_32S, cv::Scalar(1)); }

// 0 left, 1 right of the middle.
cv::Mat halves(int rows, int columns) {
  cv::Mat classes = cv::Mat::zeros(rows, columns, CV_32S);
  classes.colRange(columns / 2, columns).setTo(1);
  return classes;
}

cv::Mat checkerboard(int rows, int columns) {
  cv::Mat classes(rows, columns, CV_32S);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) classes.at<int>(y, x) = (x + y) % 2;
  return classes;
}

TEST(JsegColors, PeerGroupsTakeImpulsesOutAndKeepEdges) {
  cv::Mat luv(20, 20, CV_32FC3, cv::Scalar(20, 0, 0));
  luv.colRange(10, 20).setTo(cv::Scalar(80, 0, 0));
  luv.at<cv::Vec3f>(5, 5) = {95, 40, 40};
  const PeerGroups found = peer_group_filtered(luv, cv::Mat(20, 20, CV_8U, cv::Scalar(255)));
  EXPECT_NEAR(found.luv.at<cv::Vec3f>(5, 5)[0], 20, 0.01) << "the impulse";
  EXPECT_NEAR(found.luv.at<cv::Vec3f>(12, 9)[0], 20, 0.01) << "beside the edge";
  EXPECT_NEAR(found.luv.at<cv::Vec3f>(12, 10)[0], 80, 0.01);
  EXPECT_NEAR(found.radius.at<float>(12, 9), 0, 0.01);
}

TEST(JsegColors, PeerGroupsAskNobodyOutsideTheMask) {
  cv::Mat luv(9, 9, CV_32FC3, cv::Scalar(50, 0, 0)), mask(9, 9, CV_8U, cv::Scalar(255));
  luv.colRange(5, 9).setTo(cv::Scalar(54, 0, 0));
  mask.colRange(5, 9).setTo(0);
  const PeerGroups found = peer_group_filtered(luv, mask);
  EXPECT_NEAR(found.luv.at<cv::Vec3f>(4, 4)[0], 50, 1e-3);
  EXPECT_EQ(found.luv.at<cv::Vec3f>(4, 5)[0], 54);
}

// Three colours with noise, 25 and more apart.
TEST(JsegColors, AsManyClassesAsColours) {
  cv::Mat luv(60, 60, CV_32FC3);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const auto noise = normal4(1, 1, static_cast<std::uint64_t>(60 * y + x));
      luv.at<cv::Vec3f>(y, x) = cv::Vec3f(30.f + 25.f * static_cast<float>(x / 20), 10, static_cast<float>(noise[0]));
    }
  }
  const cv::Mat mask(60, 60, CV_8U, cv::Scalar(255));
  const ColorClasses found = quantized(peer_group_filtered(luv, mask), mask, {});
  ASSERT_EQ(found.count(), 3);
  for (const int x : {10, 30, 50}) {
    const int of = found.classes.at<int>(30, x);
    EXPECT_NEAR(found.luv[of][0], 30 + 25 * (x / 20), 0.5);
    EXPECT_EQ(cv::countNonZero(found.classes == of), 1200);
  }
  EXPECT_EQ(quantized(peer_group_filtered(luv, mask), mask, {0, 2}).count(), 2);
  EXPECT_EQ(quantized(peer_group_filtered(luv, mask), mask, {0, 1}).count(), 1);
  EXPECT_EQ(quantized(peer_group_filtered(luv, mask), mask, {600, 0}).count(), 3) << "25 squared is more";
}

// Two halves of a strip of length n: S_T is (n^2 - 1) / 12 a pixel, S_W is ((n / 2)^2 - 1) / 12, if it has one row.
TEST(JsegTexture, JTellsHalvesFromACheckerboard) {
  EXPECT_NEAR(j_of(halves(1, 100)), (10000.0 - 1) / (2500.0 - 1) - 1, 1e-9);
  EXPECT_NEAR(j_of(checkerboard(100, 100)), 0, 1e-6);
  EXPECT_EQ(j_of(cv::Mat::zeros(10, 10, CV_32S)), 0);
}

// The window of 61 samples by hand: rows of 3, 7, 7, 9, 9, 9, 7, 7, 3.
double j_by_hand(const cv::Mat& classes, int y, int x, int step) {
  cv::Mat window(9, 9, CV_32S, cv::Scalar(-1));
  const std::array<int, 9> half_rows = {1, 3, 3, 4, 4, 4, 3, 3, 1};
  for (int dy = -4; dy <= 4; ++dy)
    for (int dx = -half_rows[dy + 4]; dx <= half_rows[dy + 4]; ++dx)
      window.at<int>(dy + 4, dx + 4) = classes.at<int>(std::clamp(y + step * dy, 0, classes.rows - 1),
                                                       std::clamp(x + step * dx, 0, classes.cols - 1));
  EXPECT_EQ(cv::countNonZero(window >= 0), 61);
  return std::min<double>(kMostJ, j_of(window));
}

TEST(JsegTexture, JImageIsTheDefinition) {
  cv::Mat classes(40, 50, CV_32S);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x)
      classes.at<int>(y, x) =
          static_cast<int>(4 * uniform(3, 1, static_cast<std::uint64_t>(50 * y + x))) + (x > 25 ? 2 : 0);
  const cv::Mat j = j_image(classes, 6, all_of(classes.size()), 1);
  for (const auto& [y, x] :
       {std::pair(20, 25), std::pair(0, 0), std::pair(3, 49), std::pair(39, 20), std::pair(10, 10)})
    EXPECT_NEAR(j.at<float>(y, x), j_by_hand(classes, y, x, 1), 1e-5) << y << " " << x;
  // At scale 2 and above the same, smoothed twice by the mean of 3 x 3.
  cv::Mat raw(40, 50, CV_32F), smooth;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x) raw.at<float>(y, x) = static_cast<float>(j_by_hand(classes, y, x, 2));
  cv::blur(raw, smooth, {3, 3});
  cv::blur(smooth, smooth, {3, 3});
  EXPECT_NEAR(j_image(classes, 6, all_of(classes.size()), 2).at<float>(20, 24), smooth.at<float>(20, 24), 1e-5);
}

TEST(JsegTexture, HighAtABorderLowInATexture) {
  const cv::Mat j = j_image(halves(60, 60), 2, all_of({60, 60}), 1),
                even = j_image(checkerboard(60, 60), 2, all_of({60, 60}), 1);
  EXPECT_EQ(j.at<float>(30, 10), 0);
  EXPECT_GT(j.at<float>(30, 30), 0.5);
  EXPECT_LT(even.at<float>(30, 30), 0.01);
}

// A border of regions parts the samples: neither side sees the other's class.
TEST(JsegTexture, OtherRegionsDoNotCount) {
  const cv::Mat classes = halves(40, 40), regions = classes + 1;
  for (const int scale : {1, 2, 3}) EXPECT_EQ(cv::countNonZero(j_image(classes, 2, regions, scale)), 0) << scale;
}

TEST(JsegGrowing, PiecesAreFourConnectedAndInOrder) {
  const cv::Mat keys = (cv::Mat_<int>(3, 4) << 5, 0, 5, 5, 0, 5, 0, 5, 7, 7, 7, 0);
  const LabelMap all = connected_pieces(keys);
  EXPECT_EQ(all.count, 4);
  EXPECT_EQ(all.labels.at<int>(0, 0), 1);
  EXPECT_EQ(all.labels.at<int>(1, 3), 2);
  EXPECT_EQ(all.labels.at<int>(1, 1), 3);
  EXPECT_EQ(all.labels.at<int>(2, 2), 4);
  const LabelMap large = connected_pieces(keys, 3);
  EXPECT_EQ(large.count, 2);
  EXPECT_EQ(large.labels.at<int>(0, 0), 0);
}

// J low in two places with a ridge between: two valleys, and they grow to meet on it.
TEST(JsegGrowing, ValleysGrowUpToTheRidge) {
  cv::Mat j(40, 60, CV_32F);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) j.at<float>(y, x) = 1.f / static_cast<float>(1 + std::abs(x - 22));
  const cv::Mat whole = all_of(j.size());
  const LabelMap seeds = valleys(j, whole, 1);
  ASSERT_EQ(seeds.count, 2);
  EXPECT_EQ(seeds.labels.at<int>(20, 22), 0);
  const LabelMap regions = grown(seeds, whole, {j}, 1);
  EXPECT_EQ(regions.count, 2);
  for (int y = 0; y < 40; ++y) {
    EXPECT_EQ(regions.labels.at<int>(y, 21), 1);
    EXPECT_EQ(regions.labels.at<int>(y, 23), 2);
  }
}

TEST(JsegGrowing, WithoutValleysARegionStaysWhole) {
  const cv::Mat whole = all_of({6, 5});  // smaller than the smallest valley
  const cv::Mat j = cv::Mat::zeros(5, 6, CV_32F);
  const LabelMap seeds = valleys(j, whole, 1);
  EXPECT_EQ(seeds.count, 0);
  const LabelMap regions = grown(seeds, whole, {j}, 1);
  EXPECT_EQ(regions.count, 1);
  EXPECT_EQ(cv::countNonZero(regions.labels == 1), 30);
}

// Three stripes of classes 0, 0 with a tenth of 1, and 1: the first two are 0.14 apart, the third is far.
TEST(JsegMerging, JoinsTheNearestHistogramsAndNoOthers) {
  cv::Mat classes = cv::Mat::zeros(10, 30, CV_32S), labels(10, 30, CV_32S);
  for (int x = 0; x < 30; ++x) labels.col(x).setTo(x / 10 + 1);
  classes.row(0).colRange(10, 20).setTo(1);
  classes.colRange(20, 30).setTo(1);
  const LabelMap regions{labels, 3};
  EXPECT_EQ(merged(regions, classes, 2, 0.1).count, 3);
  const LabelMap two = merged(regions, classes, 2, 0.4);
  EXPECT_EQ(two.count, 2);
  EXPECT_EQ(two.labels.at<int>(5, 15), 1);
  EXPECT_EQ(two.labels.at<int>(5, 25), 2);
  EXPECT_EQ(merged(regions, classes, 2, 1.42).count, 1);
}

TEST(JsegMerging, RegionsThatDoNotTouchStayApart) {
  cv::Mat classes = cv::Mat::zeros(10, 30, CV_32S), labels(10, 30, CV_32S);
  for (int x = 0; x < 30; ++x) labels.col(x).setTo(x / 10 + 1);
  classes.colRange(10, 20).setTo(1);
  EXPECT_EQ(merged({labels, 3}, classes, 2, 0.4).count, 3);
}

TEST(Jseg, TwoColoursAreTwoRegions) {
  cv::Mat image(100, 140, CV_8UC3, cv::Scalar(200, 60, 40));
  image.colRange(60, 140).setTo(cv::Scalar(40, 160, 60));
  const JsegResult found = jseg(image, {}, {});
  ASSERT_EQ(found.region_count, 2);
  for (int y = 0; y < 100; ++y) {
    EXPECT_EQ(found.regions.at<int>(y, 58), 1);
    EXPECT_EQ(found.regions.at<int>(y, 61), 2);
  }
}

TEST(Jseg, OneTextureIsOneRegion) {
  cv::Mat image(160, 160, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<cv::Vec3b>(y, x) = (x / 4 + y / 4) % 2 ? cv::Vec3b(40, 40, 180) : cv::Vec3b(220, 220, 210);
  EXPECT_EQ(jseg(image, {}, {}).region_count, 1);
  for (Seed seed = 1; seed <= 5; ++seed)
    EXPECT_EQ(jseg(texture_mosaic(seed, 1, {150, 150}).bgr, {}, {}).region_count, 1);
  EXPECT_EQ(jseg(cv::Mat(90, 90, CV_8UC3, cv::Scalar(80, 90, 100)), {}, {}).region_count, 1);
}

// Colours that the automatic threshold would all put into one class.
TEST(Jseg, LittleContrastIsSegmentedToo) {
  cv::Mat image(120, 120, CV_8UC3, cv::Scalar::all(120));
  image.colRange(0, 50).setTo(cv::Scalar::all(140));
  EXPECT_EQ(jseg(image, {}, {}).region_count, 2);
}

TEST(Jseg, LooksAtTheMaskAlone) {
  cv::Mat image(80, 120, CV_8UC3, cv::Scalar(200, 60, 40)), mask = cv::Mat::zeros(80, 120, CV_8U);
  image.colRange(60, 120).setTo(cv::Scalar(40, 160, 60));
  mask(cv::Rect(5, 5, 40, 70)).setTo(255);
  mask(cv::Rect(80, 5, 30, 70)).setTo(1);
  const JsegResult found = jseg(image, mask, {});
  EXPECT_EQ(found.region_count, 2) << "pieces of the mask that do not touch";
  EXPECT_EQ(cv::countNonZero(found.regions), cv::countNonZero(mask));
  EXPECT_EQ(cv::countNonZero(found.regions == 1), 40 * 70);
  EXPECT_EQ(jseg(image, cv::Mat::zeros(80, 120, CV_8U), {}).region_count, 0);
}

TEST(Jseg, TinyImagesAndWrongOnes) {
  EXPECT_EQ(jseg(cv::Mat(1, 1, CV_8UC3, cv::Scalar(1, 2, 3)), {}, {}).region_count, 1);
  EXPECT_EQ(jseg(cv::Mat(1, 300, CV_8UC3, cv::Scalar(1, 2, 3)), {}, {}).region_count, 1);
  EXPECT_THROW(jseg(cv::Mat(9, 9, CV_8U), {}, {}), InputError);
  EXPECT_THROW(jseg(cv::Mat(), {}, {}), InputError);
  EXPECT_THROW(jseg(cv::Mat(9, 9, CV_8UC3), cv::Mat(8, 9, CV_8U), {}), InputError);
}

// 320 pixels a side: large enough to begin at scale 3, whose window of 33 pixels holds a few periods of every texture.
TEST(Jseg, BordersOfTextureMosaics) {
  double sum = 0;
  int count = 0;
  for (Seed seed = 1; seed <= 5; ++seed) {
    const auto mosaic = texture_mosaic(seed, 4 + static_cast<int>(seed) % 4);
    const double f = boundary_f(jseg(mosaic.bgr, {}, {}).regions, mosaic.regions, 3);
    EXPECT_GT(f, 0.85) << "seed " << seed;
    sum += f, ++count;
  }
  EXPECT_GT(sum / count, 0.9);
}

TEST(Jseg, SameWithOneThread) {
  const auto mosaic = texture_mosaic(2, 5, {200, 160});
  JsegResult one;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = jseg(mosaic.bgr, {}, {});
  }
  const JsegResult many = jseg(mosaic.bgr, {}, {});
  EXPECT_EQ(cv::norm(one.regions, many.regions, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.colors.classes, many.colors.classes, cv::NORM_INF), 0);
  EXPECT_EQ(one.j.size(), many.j.size());
  for (std::size_t s = 0; s < one.j.size(); ++s) EXPECT_EQ(cv::norm(one.j[s], many.j[s], cv::NORM_INF), 0);
}

}  // namespace
}  // namespace dressform
