#include "synthetic/garments/print.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "scenes/error.h"

namespace dressform {
namespace {

TEST(Print, HasTheAskedSizeAndColours) {
  PrintSpec spec;
  for (const std::string kind :
       {"plain", "stars", "complex", "stripes", "plaid", "denim", "weave", "characters", "all_over", "noise"}) {
    spec.kind = kind;
    spec.colors = {"#204060", "#ffffff"};
    const cv::Mat image = paint_print(spec, 0.5, 0.4, 1000, 5);
    EXPECT_EQ(image.size(), cv::Size(500, 400)) << kind;
    EXPECT_EQ(cv::norm(image, paint_print(spec, 0.5, 0.4, 1000, 5), cv::NORM_INF), 0) << kind;
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    EXPECT_GT(mean[0], mean[2]) << kind;  // bluish ground, BGR
    EXPECT_GT(deviation[0], 0.5) << kind;
  }
  spec.kind = "zebra";
  EXPECT_THROW(paint_print(spec, 0.5, 0.4, 1000, 5), InputError);
  spec.kind = "plain";
  spec.colors = {"blue"};
  EXPECT_THROW(paint_print(spec, 0.5, 0.4, 1000, 5), InputError);
}

}  // namespace
}  // namespace dressform
