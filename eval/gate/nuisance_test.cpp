#include "eval/gate/nuisance.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eval/gate/accept.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

GoldenRun run_elsewhere(const std::string& compiler, double f, int level = 100) {
  GoldenRun run;
  run.scores = {"group1", "default", 1, {}};
  run.scores.rows = {{"surface", "top/f_5mm@1", "1", f, "ok", 10},
                     {"surface", "bottom/f_5mm@1", "1", 0.9, "ok", 10},
                     {"open", "top/components@1", "count", 1, "ok", 1}};
  run.images = {{"result", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(level))}};
  run.steps = {{"capture", "c", "scene"}, {"scores", std::to_string(f), "c"}};
  run.environment = {{"compiler", compiler}};
  return run;
}

std::vector<PlaceRuns> some_places() {
  std::vector<PlaceRuns> places;
  const double values[] = {0.93, 0.9315, 0.929, 0.93};
  for (int k = 0; k < 4; ++k)
    places.push_back(
        {"build " + std::to_string(k), {{"group1", run_elsewhere("GNU " + std::to_string(k), values[k])}}});
  return places;
}

TEST(Nuisance, ToleranceIsTwiceTheLargestDistanceOverAllRowsOfAMetric) {
  const auto nuisance = measure_nuisance(some_places());
  ASSERT_TRUE(nuisance.usable());
  EXPECT_NEAR(*nuisance.tolerance({"surface", "top/f_5mm@1", "1", 0.5, "ok", 1}), 0.003, 1e-12);
  EXPECT_NEAR(*nuisance.tolerance({"surface", "bottom/f_5mm@1", "1", 0.5, "ok", 1}), 0.003, 1e-12) << "one metric";
  EXPECT_EQ(*nuisance.tolerance({"open", "top/components@1", "count", 1, "ok", 1}), 0) << "counts are exact";
  EXPECT_FALSE(nuisance.tolerance({"surface", "top/f_2mm@1", "1", 0.5, "ok", 1})) << "nothing was measured for it";
  EXPECT_EQ(nuisance.places[1].changed_steps, 1);
  EXPECT_EQ(nuisance.places[3].changed_steps, 0) << "the same bytes: no other program in effect";
}

TEST(Nuisance, ThePlaceLeftOutIsJudgedByTheOthers) {
  const auto nuisance = measure_nuisance(some_places());
  const auto left_out = leave_one_out(nuisance);
  ASSERT_EQ(left_out.size(), 2u) << "the one with the bytes of the reference is no sample";
  EXPECT_EQ(nuisance.distinct(), 3u);
  EXPECT_TRUE(left_out[0].alarms.empty()) << "0.0015 against twice 0.001";
  EXPECT_TRUE(left_out[1].alarms.empty());
  auto places = some_places();
  places[1].runs["group1"] = run_elsewhere("GNU 1", 0.94);
  const auto alarmed = leave_one_out(measure_nuisance(places));
  EXPECT_EQ(alarmed[0].alarms, std::vector<std::string>{"surface <slot>/f_5mm@1"});
  EXPECT_TRUE(alarmed[1].alarms.empty());
}

// Exact: 1 - 0.05^(1/n) for none of n.
TEST(Nuisance, TheBoundIsWhatSoFewEnvironmentsGive) {
  EXPECT_NEAR(alarm_rate_bound(0, 8), 0.3123, 1e-4);
  EXPECT_NEAR(alarm_rate_bound(0, 59), 0.0495, 1e-4);
  EXPECT_NEAR(alarm_rate_bound(1, 8), 0.4707, 1e-4);
  EXPECT_EQ(alarm_rate_bound(3, 3), 1);
  EXPECT_EQ(alarm_rate_bound(0, 0), 1);
}

TEST(Nuisance, RepeatsOfOneEnvironmentAreNoSamples) {
  auto places = some_places();
  places.push_back({"again", {{"group1", run_elsewhere("GNU 0", 0.93)}}});
  EXPECT_THROW(measure_nuisance(places), InputError);
  auto lacking = some_places();
  lacking[2].runs.clear();
  EXPECT_THROW(measure_nuisance(lacking), InputError);
  EXPECT_THROW(measure_nuisance({}), InputError);
}

TEST(Nuisance, ThreePlacesAreTheLeastThatSayAnything) {
  auto places = some_places();
  places.resize(2);
  const auto nuisance = measure_nuisance(places);
  EXPECT_FALSE(nuisance.usable());
  EXPECT_FALSE(nuisance.tolerance({"surface", "top/f_5mm@1", "1", 0.5, "ok", 1}));
  EXPECT_FALSE(nuisance.picture_tolerance().measured);
}

TEST(Nuisance, AnotherStatusIsToldAndNoTolerance) {
  auto places = some_places();
  places[1].runs["group1"].scores.rows[2].status = "failed";
  const auto nuisance = measure_nuisance(places);
  ASSERT_EQ(nuisance.status_changes.size(), 1u);
  EXPECT_NE(nuisance.status_changes[0].find("top/components@1"), std::string::npos);
}

TEST(Nuisance, PicturesAreMeasuredToo) {
  auto places = some_places();
  places[2].runs["group1"] = run_elsewhere("GNU 2", 0.929, 103);
  const auto tolerance = measure_nuisance(places).picture_tolerance();
  EXPECT_TRUE(tolerance.measured);
  EXPECT_NEAR(tolerance.mean_levels, 6, 1e-9);
  EXPECT_NEAR(tolerance.worst_tile_levels, 6, 1e-9);
  EXPECT_GT(tolerance.flip, 0);
}

TEST(Nuisance, TheGateJudgesByWhatWasMeasured) {
  GoldenCase empty;
  empty.name = "group1";
  const auto golden = accepted(empty, run_elsewhere("GNU 0", 0.93), {"first", {}, {}}).golden;
  const auto nuisance = measure_nuisance(some_places());
  const auto run = run_elsewhere("GNU 0", 0.925);  // within the declared 0.01, beyond the measured 0.003
  EXPECT_EQ(compare_with_golden(golden, run).verdict, GateVerdict::pass);
  const auto measured = compare_with_golden(golden, run, nuisance);
  EXPECT_EQ(measured.verdict, GateVerdict::regression);
  EXPECT_NE(measured.findings[0].message.find("(measured)"), std::string::npos);
  EXPECT_TRUE(measured.unmeasured.empty());
}

TEST(Nuisance, SurvivesItsFileAndDamageIsAGoldenError) {
  const fs::path folder = fs::path(testing::TempDir()) / "nuisance_files";
  fs::remove_all(folder);
  EXPECT_FALSE(read_nuisance(folder));
  const auto nuisance = measure_nuisance(some_places());
  write_nuisance(folder, nuisance);
  const auto read = read_nuisance(folder);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->metrics, nuisance.metrics);
  EXPECT_EQ(read->pictures, nuisance.pictures);
  EXPECT_EQ(read->places[1].environment, nuisance.places[1].environment);
  EXPECT_EQ(read->cases, nuisance.cases);
  std::ofstream(folder / "nuisance.json") << R"({"format": "dressform-nuisance", "version": 1, "metrics": 3})";
  EXPECT_THROW(read_nuisance(folder), GoldenError);
  std::ofstream(folder / "nuisance.json") << "{";
  EXPECT_THROW(read_nuisance(folder), GoldenError);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dressform
