#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "render/charts/cairo_canvas.h"
#include "render/charts/chart.h"
#include "render/charts/markup.h"
#include "render/charts/panels.h"
#include "render/charts/row_chart.h"

namespace dressform {
namespace {

using testing::HasSubstr;
using testing::Not;

// A square of red over 10 to 20 mm of a page of 40 x 30.
Sheet red_square() {
  return {40, 30, "Red & square", [](Canvas& canvas) {
            canvas.polygon({{10, 10}, {20, 10}, {20, 20}, {10, 20}}, {255, 0, 0, 1});
            canvas.text({2, 28}, "σ ≤ 3°", {3});
          }};
}

TEST(Sheet, PixelsLieWhereTheMillimetresSay) {
  const cv::Mat image = sheet_image(red_square(), 25.4 * 4);  // four pixels a millimetre
  ASSERT_EQ(image.size(), cv::Size(160, 120));
  EXPECT_EQ(image.at<cv::Vec3b>(60, 60), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(image.at<cv::Vec3b>(40, 40), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(image.at<cv::Vec3b>(39, 60), cv::Vec3b::all(255));
  EXPECT_EQ(image.at<cv::Vec3b>(80, 60), cv::Vec3b::all(255));
}

TEST(Sheet, EveryFormatGivesTheSameBytesTwice) {
  EXPECT_EQ(sheet_pdf(red_square()), sheet_pdf(red_square()));
  EXPECT_EQ(sheet_svg(red_square()), sheet_svg(red_square()));
  EXPECT_EQ(sheet_png(red_square(), 150), sheet_png(red_square(), 150));
}

TEST(Sheet, PdfHasNoDateOfTodayAndNoType3Font) {
  const std::string pdf = sheet_pdf(red_square());
  EXPECT_THAT(pdf, testing::StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("20000101"));
  EXPECT_THAT(pdf, Not(HasSubstr("/Type3")));
}

TEST(Sheet, SvgKeepsLettersAsLettersAndNamesItself) {
  const std::string svg = sheet_svg(red_square());
  EXPECT_THAT(svg, HasSubstr("σ ≤ 3°</text>"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"Red &amp; square\""));
}

TEST(Sheet, PngSaysItsResolutionAndStillDecodes) {
  const std::string png = sheet_png(red_square(), 254);
  const auto at = png.find("pHYs");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(png.substr(at + 4, 4), std::string("\0\0\x27\x10", 4));  // 10000 pixels a metre
  const std::vector<unsigned char> bytes(png.begin(), png.end());
  EXPECT_EQ(cv::imdecode(bytes, cv::IMREAD_COLOR).size(), cv::Size(400, 300));
}

TEST(Text, WidthGrowsWithTheLettersAndTheSize) {
  const double one = text_width_mm("measure", 3);
  EXPECT_GT(one, 8);
  EXPECT_LT(one, 20);
  EXPECT_NEAR(text_width_mm("measure", 6), 2 * one, 0.01);
  EXPECT_NEAR(text_width_mm("measuremeasure", 3), 2 * one, 0.1);
  EXPECT_GT(text_width_mm("measure", 3, true), one);
}

TEST(Text, IsClippedBetweenLettersAndWrappedBetweenWords) {
  const std::string text = "größer größer größer";
  const std::string clipped = clipped_text(text, 3, 0.5 * text_width_mm(text, 3));
  EXPECT_LE(text_width_mm(clipped, 3), 0.5 * text_width_mm(text, 3));
  EXPECT_THAT(clipped, testing::EndsWith("…"));
  EXPECT_EQ(clipped_text(text, 3, 1000), text);
  EXPECT_THAT(wrapped_text(text, 3, 1.1 * text_width_mm("größer", 3)),
              testing::ElementsAre("größer", "größer", "größer"));
  EXPECT_THAT(wrapped_text(text, 3, 1000), testing::ElementsAre(text));
}

TEST(Text, IsWrittenIntoAnImageInItsInk) {
  cv::Mat image(40, 120, CV_8UC3, cv::Scalar::all(255));
  write_text(image, {4, 30}, "IIII", 28, {255, 0, 0, 1});
  const cv::Mat inked = image.reshape(1, static_cast<int>(image.total()));
  double least_blue = 0;
  cv::minMaxLoc(inked.col(0), &least_blue);
  EXPECT_LT(least_blue, 40);
  double least_red = 0;
  cv::minMaxLoc(inked.col(2), &least_red);
  EXPECT_GT(least_red, 250);
  EXPECT_THROW(write_text(image = cv::Mat(), {0, 0}, "x", 10), std::invalid_argument);
}

TEST(Markup, EscapesAndBase64) {
  EXPECT_EQ(html_escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Panels, AreLetteredInOrderAndFillTheWidth) {
  EXPECT_EQ(panel_letter(0), "(a)");
  EXPECT_EQ(panel_letter(25), "(z)");
  EXPECT_EQ(panel_letter(26), "(aa)");
  PanelFigure figure{"f", {}, {}, true};
  const cv::Mat green(100, 100, CV_8UC3, cv::Scalar(0, 255, 0));
  figure.rows = {{{{green, "first"}, {cv::Mat(), "none"}, {green, ""}}, ""}, {{{green, ""}}, "side"}};
  const std::string svg = sheet_svg(panel_sheet(figure));
  EXPECT_THAT(svg, HasSubstr(">(a) first</text>"));
  EXPECT_THAT(svg, HasSubstr(">(b)</text>"));
  EXPECT_THAT(svg, HasSubstr(">(c)</text>"));  // a picture that is not there takes no letter
  EXPECT_THAT(svg, Not(HasSubstr("none</text>")));
  EXPECT_THAT(svg, HasSubstr(">side</text>"));
  EXPECT_THROW(panel_sheet(PanelFigure{"f", {{{{cv::Mat(), ""}}, ""}}, {}, true}), std::invalid_argument);
}

TEST(Panels, ScaleStandsBesideThePictures) {
  PanelFigure figure{"f", {{{{cv::Mat(100, 300, CV_8UC3, cv::Scalar(0, 255, 0)), ""}}, ""}}, {}, false};
  figure.scale = ColorScale{0, 10, "distance", "mm"};
  const Sheet sheet = panel_sheet(figure);
  EXPECT_THAT(sheet_svg(sheet), HasSubstr(">distance [mm]</text>"));
  EXPECT_THAT(sheet_svg(sheet), HasSubstr(">10</text>"));
  const cv::Mat image = sheet_image(sheet, 100);
  cv::Mat green;
  cv::inRange(image, cv::Scalar(0, 255, 0), cv::Scalar(0, 255, 0), green);
  const cv::Rect box = cv::boundingRect(green);
  EXPECT_LT(box.x, 3);
  EXPECT_NEAR(static_cast<double>(box.width) / box.height, 3, 0.05);
  EXPECT_LT(box.width, image.cols - 30);
}

RowChart two_rows() {
  RowChart chart;
  chart.title = "t", chart.axis = "difference, mm", chart.left_word = "better", chart.right_word = "worse";
  chart.line = 0, chart.margin = 1;
  chart.rows = {{"low", {{-4, 1}}, -4.0, RowChart::Span{-5, -3}, "better"}, {"high", {{4, 1}}, {}, {}, ""}};
  return chart;
}

TEST(RowChart, HasNamesSidesAndNotes) {
  const std::string svg = sheet_svg(row_chart_sheet(two_rows()));
  for (const char* text : {">low</text>", ">high</text>", "← better", "worse →", ">difference, mm</text>", ">0</text>"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(RowChart, LargerValuesLieFurtherRight) {
  const cv::Mat image = sheet_image(row_chart_sheet(two_rows()), 96);
  const auto blue_columns = [&](int from, int to) {
    cv::Mat blue;
    cv::inRange(image.rowRange(from, to), cv::Scalar(170, 105, 0), cv::Scalar(185, 120, 10), blue);
    return cv::boundingRect(blue).x;
  };
  EXPECT_GT(blue_columns(78, 104), image.cols / 2);  // the second row; its dot is not pale, there is no mean
  EXPECT_EQ(blue_columns(52, 76), 0);                // the first row's dot is pale, under the mean
}

TEST(RowChart, WithNothingInItIsStillAChart) {
  EXPECT_THAT(sheet_svg(row_chart_sheet(RowChart{})), testing::EndsWith("</svg>"));
}

TEST(Charts, NarrowColumnsPutTheLegendBelow) {
  Chart chart;
  chart.x = {"x", 0, 1}, chart.y = {"y", 0, 1};
  chart.curves.push_back({"a name as wide as half a column", Curve::line, 1, {{0, 0}, {1, 1}}});
  const Sheet narrow = chart_sheet(chart, kColumnStyle), wide = chart_sheet(chart, kScreenStyle);
  EXPECT_EQ(narrow.width_mm, kColumnStyle.width_mm);
  EXPECT_GT(narrow.height_mm, kColumnStyle.chart_part * kColumnStyle.width_mm);
  EXPECT_NEAR(wide.height_mm, kScreenStyle.chart_part * kScreenStyle.width_mm, 1e-9);
}

}  // namespace
}  // namespace dressform
