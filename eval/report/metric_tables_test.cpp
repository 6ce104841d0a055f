#include "eval/report/metric_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

using testing::HasSubstr;

TEST(MetricTables, DocumentsShowWhatIsDeclared) {
  for (const char* name : {"README.md", "eval/README.md"}) {
    const std::string document = read_file_bytes(std::filesystem::path(DRESSFORM_SOURCE_DIR) / name);
    EXPECT_EQ(document, with_metric_tables(document, name))
        << "write it anew: dressform metrics --write README.md --write eval/README.md";
  }
}

TEST(MetricTables, OnlyWhatLiesBetweenTheMarksIsWritten) {
  const std::string before = "a\n<!-- metrics -->\nwas here before\n<!-- /metrics -->\nb";
  const std::string after = with_metric_tables(before, "x.md");
  EXPECT_EQ(after.substr(0, 19), before.substr(0, 19));
  EXPECT_THAT(after, HasSubstr("`<slot>/f_5mm@1`"));
  EXPECT_THAT(after, Not(HasSubstr("was here before")));
  EXPECT_EQ(after.substr(after.size() - 20), "\n<!-- /metrics -->\nb");
  EXPECT_EQ(with_metric_tables(after, "x.md"), after);
  EXPECT_THROW(with_metric_tables("no table\n", "x.md"), InputError);
  EXPECT_THROW(with_metric_tables("", "x.md"), InputError);
  EXPECT_THROW(with_metric_tables("<!-- metrics -->\nno end", "x.md"), InputError);
}

TEST(MetricTables, EveryFormatHasEveryMetricOnce) {
  const auto all = metrics_of("");
  const auto json = nlohmann::json::parse(metrics_json(all));
  EXPECT_EQ(json.at("metrics").size(), all.size());
  const std::string csv = metrics_csv(all), markdown = metrics_markdown(all);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<long>(all.size()) + 1);
  EXPECT_EQ(std::count(markdown.begin(), markdown.end(), '\n'), static_cast<long>(all.size()) + 2);
  EXPECT_THAT(csv, HasSubstr("surface,<slot>/f_5mm,1,1,higher,0.85,,1,F at 5 mm,ratio,0.01,0,"));
  EXPECT_LT(metrics_of("open").size(), all.size());
  try {
    metrics_of("opne");
    FAIL() << "an unknown stage was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("calibrate, fuse, registration"));
  }
}

}  // namespace
}  // namespace dressform
