#include "pipeline/segment/hem_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace dressform {
namespace {

TEST(HemCurve, FollowsASlantedEdgeThroughAGap) {
  cv::Mat nats(100, 36, CV_32F);
  for (int c = 0; c < nats.cols; ++c)
    for (int r = 0; r < nats.rows; ++r) nats.at<float>(r, c) = r >= 50 + 10 * std::cos(2 * M_PI * c / 36) ? 3.f : -3.f;
  nats.colRange(10, 14).setTo(0);
  const auto hem = trace_hem(nats, 1);
  for (int c = 0; c < nats.cols; ++c)
    EXPECT_NEAR(hem[c], 50 + 10 * std::cos(2 * M_PI * c / 36), c >= 10 && c < 14 ? 8 : 1);
}

// Two ninths of the curve went astray: the hem is the plane through the rest.
TEST(HemCurve, StaysNearItsPlane) {
  const auto plane = [](int c) { return 60 + 8 * std::cos(2 * M_PI * c / 36) - 5 * std::sin(2 * M_PI * c / 36); };
  std::vector<int> curve(36);
  for (int c = 0; c < 36; ++c) curve[c] = c >= 12 && c < 20 ? 110 : static_cast<int>(std::lround(plane(c)));
  const cv::Mat held = near_plane(cv::Mat::zeros(150, 36, CV_32F), curve, 10, 3);
  for (int c = 0; c < 36; ++c) {
    for (int r = 0; r < 150; ++r) {
      const float nats = held.at<float>(r, c);
      const double off = r - plane(c);
      if (std::abs(off) < 6) {
        EXPECT_EQ(nats, 0) << r << " " << c;
      } else if (std::abs(off) > 14) {
        EXPECT_GT(off * nats, 0) << r << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace dressform
