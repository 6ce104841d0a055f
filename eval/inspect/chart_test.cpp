#include "eval/inspect/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dressform {
namespace {

using testing::HasSubstr;
using testing::Not;

Chart some_chart() {
  Chart chart{"some", "A <title>", "", {"x [m]", 0, 10}, {"y [mm]", 1, 100, true}, {}, {}, {}};
  chart.bands.push_back({"±15 %", 3, {{0, 5, 8}, {10, 20, 1000}}});
  chart.curves.push_back({"a & b", Curve::line, 1, {{-5, 10}, {5, 10}, {20, 20}}});
  chart.curves.push_back({"dots", Curve::dots, 2, {{5, 1e-9}, {5, 50}}});
  chart.whiskers.push_back({"expected", 0, {{5, 2, 3, 4}}});
  return chart;
}

TEST(Charts, SvgHoldsWhatWasMeantAndNothingLeavesTheBox) {
  const std::string svg = chart_svg(some_chart());
  EXPECT_THAT(svg, HasSubstr("A &lt;title&gt;"));
  EXPECT_THAT(svg, HasSubstr("a &amp; b"));
  EXPECT_THAT(svg, HasSubstr("y [mm]"));
  EXPECT_THAT(svg, HasSubstr(">50</text>"));  // a tick
  EXPECT_THAT(svg, HasSubstr("±15 %"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("-1")));  // no coordinate is negative
  EXPECT_THAT(svg, testing::EndsWith("</svg>"));
}

TEST(Charts, ImageIsTwiceAsLargeAndColoured) {
  const cv::Mat image = chart_image(some_chart());
  EXPECT_EQ(image.size(), cv::Size(1440, 800));
  EXPECT_EQ(image.type(), CV_8UC3);
  // The line at y = 10 lies in the middle of the logarithmic axis, in blue.
  const cv::Vec3b line = image.at<cv::Vec3b>(2 * (36 + 344) / 2, 2 * 100);
  EXPECT_GT(line[0], line[2] + 80);
}

TEST(Charts, AxisHoldsAllValues) {
  Chart chart = some_chart();
  const Axis axis = axis_around(chart, "y");
  EXPECT_LE(axis.minimum, 0);
  EXPECT_GE(axis.maximum, 1000);
  EXPECT_EQ(axis_around(Chart{}, "y").minimum, 0);
  EXPECT_GT(axis_around(Chart{}, "y").maximum, 0);
}

}  // namespace
}  // namespace dressform
