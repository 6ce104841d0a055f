#include "eval/report/browse_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dressform {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(BrowsePage, ASparklineRisesWithTheValues) {
  const std::string svg = sparkline_svg({"1", "", "3"});
  EXPECT_THAT(svg, HasSubstr("points=\"2.0,16.0 88.0,2.0 \""));  // y is down; what is not there is passed over
  EXPECT_THAT(svg, HasSubstr("from 1 to 3 over 2 runs"));
  EXPECT_EQ(sparkline_svg({"", "2"}), "");
  EXPECT_THAT(sparkline_svg({"2", "2"}), Not(HasSubstr("nan")));
}

TEST(BrowsePage, MarksValuesByTheirTargetsAndLinksReports) {
  BrowsedRun good{"a&b", "group1", "default", "1", "1", "0123", true, "", {"0.90"}, {"ok"}};
  BrowsedRun bad{"c", "group1", "default", "1", "1", "0123", false, "", {"0.10"}, {"ok"}};
  BrowsedRun failed{"d", "group1", "default", "1", "1", "0123", false, "", {""}, {"failed"}};
  const std::string html = browse_html("Runs", {{"surface", "top/f_5mm@1"}}, {good, bad, failed});
  EXPECT_THAT(html, HasSubstr("<a href=\"a&amp;b/report.html\">"));
  EXPECT_THAT(html, HasSubstr("class=\"good\" data-value=\"0.90\""));
  EXPECT_THAT(html, HasSubstr("class=\"bad\" data-value=\"0.10\""));
  EXPECT_THAT(html, HasSubstr("data-value=\"\">failed</td>"));
  EXPECT_THAT(html, HasSubstr("from 0.1 to 0.9 over 2 runs"));
  EXPECT_THAT(html, Not(HasSubstr("http:")));
  EXPECT_THAT(html, Not(HasSubstr("https:")));
}

}  // namespace
}  // namespace dressform
