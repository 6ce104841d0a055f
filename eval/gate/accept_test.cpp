#include "eval/gate/accept.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const std::string kTurn = "registration max/rotation_deg@1", kPart = "surface top/f_5mm@1";

GoldenRun invented_run(double rotation_deg = 0.2, double f = 0.93, int level = 100) {
  GoldenRun run;
  run.scores = {"group1", "default", 1, {}};
  run.scores.rows = {{"registration", "max/rotation_deg@1", "deg", rotation_deg, "ok", 10},
                     {"surface", "top/f_5mm@1", "1", f, "ok", 1000}};
  run.images = {{"result", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(level))}};
  run.steps = {{"capture", "c", "scene"}, {"scores", std::to_string(rotation_deg) + std::to_string(f), "c"}};
  run.environment = {{"compiler", "GNU 12"}};
  return run;
}

GoldenCase first_accept() {
  GoldenCase empty;
  empty.name = "group1";
  empty.scene = "scenes/library/group1.toml";
  return accepted(empty, invented_run(), {"first", {}, {}}).golden;
}

const GoldenScore& score_in(const GoldenCase& golden, std::size_t k) { return golden.scores.at(k); }

TEST(GateAccept, ANamedNumberIsTakenAloneAndTheRestStaysARegression) {
  const auto run = invented_run(0.3, 0.88, 160);
  const auto next = accepted(first_accept(), run, {"coarser on purpose", {kTurn}, {}}).golden;
  EXPECT_EQ(score_in(next, 0).row.value, 0.3);
  EXPECT_EQ(score_in(next, 1).row.value, 0.93);
  const auto again = compare_with_golden(next, run);
  EXPECT_EQ(again.verdict, GateVerdict::regression);
  EXPECT_EQ(again.findings.size(), 2u) << "the other number and the picture";
  EXPECT_NE(next.steps[1].content, run.steps[1].content) << "bytes stand for all of a run";
}

TEST(GateAccept, ANamedPictureIsTakenAndItsDriftAddsUp) {
  const auto once = accepted(first_accept(), invented_run(0.2, 0.93, 160), {"lighter", {"image result"}, {}}).golden;
  EXPECT_EQ(compare_with_golden(once, invented_run(0.2, 0.93, 160)).verdict, GateVerdict::pass);
  const double drift = once.image_drift.at("result");
  EXPECT_GT(drift, 0);
  const auto twice = accepted(once, invented_run(0.2, 0.93, 100), {"darker", {"image result"}, {}}).golden;
  EXPECT_NEAR(twice.image_drift.at("result"), 2 * drift, 1e-12) << "there and back again is twice the way";
}

TEST(GateAccept, NamesThatTheRunDoesNotHaveAreRefused) {
  EXPECT_THROW(accepted(first_accept(), invented_run(), {"x", {"surface top/f_6mm@1"}, {}}), InputError);
  EXPECT_THROW(accepted(first_accept(), invented_run(), {"x", {"image other"}, {}}), InputError);
}

TEST(GateAccept, BytesAreKeptWithTheEnvironmentWhenAllOfTheRunIsAccepted) {
  const auto golden = first_accept();
  EXPECT_EQ(golden.steps.size(), 2u);
  EXPECT_EQ(golden.environment.at("compiler"), "GNU 12");
  const auto same = compare_with_golden(golden, invented_run());
  EXPECT_EQ(same.bytes.state, BytesState::identical);
  const auto moved = compare_with_golden(golden, invented_run(0.201));
  EXPECT_EQ(moved.bytes.state, BytesState::changed);
  EXPECT_EQ(moved.bytes.origins, std::vector<std::string>{"scores"});
  EXPECT_EQ(moved.blame, "scores");
  EXPECT_EQ(moved.verdict, GateVerdict::pass) << "within nuisance";
}

// Steps of 0.025 degrees (1.25 tolerances): each is a regression, and each is accepted in bulk, until their sum is an
// alarm.
TEST(GateAccept, SmallStepsAddUpToAnAlarmAndTheirNameSilencesIt) {
  auto golden = first_accept();
  double rotation = 0.2;
  for (int step = 0; step < 2; ++step) {
    rotation += 0.025;
    const auto next = accepted(golden, invented_run(rotation), {"step", {}, {}});
    EXPECT_TRUE(next.left.empty()) << step;
    golden = next.golden;
  }
  EXPECT_EQ(score_in(golden, 0).first, 0.2);
  const auto within = compare_with_golden(golden, invented_run(rotation + 0.015));
  EXPECT_EQ(within.verdict, GateVerdict::regression) << "0.065 degrees from the first accept, 3.25 tolerances";
  ASSERT_EQ(within.findings.size(), 1u);
  EXPECT_EQ(within.findings[0].verdict, ItemVerdict::creep);
  rotation += 0.025;
  const auto third = accepted(golden, invented_run(rotation), {"step", {}, {}});
  EXPECT_EQ(third.left, std::vector<std::string>{kTurn});
  EXPECT_NEAR(score_in(third.golden, 0).row.value, 0.25, 1e-12) << "left as it was";
  const auto named = accepted(golden, invented_run(rotation), {"it is worth it", {kTurn}, {}}).golden;
  EXPECT_NEAR(score_in(named, 0).row.value, 0.275, 1e-12);
  EXPECT_NEAR(score_in(named, 0).known_drift, 0.075, 1e-12);
  EXPECT_EQ(compare_with_golden(named, invented_run(rotation + 0.01)).verdict, GateVerdict::pass);
}

TEST(GateAccept, OneLeapIsNoCreep) {
  const auto next = accepted(first_accept(), invented_run(0.4), {"another registration", {}, {}});
  EXPECT_TRUE(next.left.empty());
  EXPECT_EQ(compare_with_golden(next.golden, invented_run(0.41)).verdict, GateVerdict::pass);
}

TEST(GateAccept, ReferencesOfBeforeBytesWereKeptAreReadAndSaySo) {
  const fs::path folder = fs::path(testing::TempDir()) / "golden_of_before";
  fs::remove_all(folder);
  write_golden_case(folder, first_accept());
  auto text = nlohmann::json::parse(read_file_bytes(folder / "group1/golden.json"));
  for (const char* later : {"steps", "environment", "image_drift"}) text.erase(later);
  std::ofstream(folder / "group1/golden.json") << text.dump();
  const auto old = read_golden_case(folder, "group1");
  const auto result = compare_with_golden(old, invented_run());
  EXPECT_EQ(result.verdict, GateVerdict::pass);
  EXPECT_EQ(bytes_text(result.bytes), "no bytes kept: accept to keep them");
  EXPECT_EQ(score_in(old, 0).first, 0.2);
  EXPECT_EQ(accepted(old, invented_run(), {"keep bytes", {}, {}}).golden.steps.size(), 2u);
  fs::remove_all(folder);
}

TEST(GateAccept, BytesFirstValuesAndDriftSurviveTheFile) {
  const fs::path folder = fs::path(testing::TempDir()) / "golden_with_drift";
  fs::remove_all(folder);
  auto golden = first_accept();
  golden.scores[0].first = 0.1;
  golden.scores[0].known_drift = 0.1;
  golden.image_drift["result"] = 0.25;
  write_golden_case(folder, golden);
  const auto read = read_golden_case(folder, "group1");
  EXPECT_EQ(score_in(read, 0).first, 0.1);
  EXPECT_EQ(score_in(read, 0).known_drift, 0.1);
  EXPECT_EQ(read.image_drift.at("result"), 0.25);
  EXPECT_EQ(compare_with_golden(read, invented_run()).bytes.state, BytesState::identical);
  fs::remove_all(folder);
}

TEST(GateAccept, WhatARunShowedIsReadBackAndDamageIsToldByName) {
  const fs::path folder = fs::path(testing::TempDir()) / "observed_run";
  fs::remove_all(folder);
  const auto run = invented_run();
  write_golden_run(folder, run);
  EXPECT_EQ(read_golden_run(folder).identity(), run.identity());
  EXPECT_EQ(read_golden_run(folder).environment, run.environment);
  EXPECT_NE(invented_run(0.21).identity(), run.identity());
  fs::remove(folder / "result.png");
  EXPECT_THROW(read_golden_run(folder), InputError);
  fs::resize_file(folder / "observed.json", 10);
  EXPECT_THROW(read_golden_run(folder), InputError);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dressform
