#include "eval/gate/doctor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "eval/gate/accept.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

class GateDoctor : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            (std::string("doctor_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(root_);
    fs::create_directories(root_ / "scenes");
    std::ofstream(root_ / "scenes/one.toml") << "x";
    golden_ = root_ / "golden";
    write_golden_case(golden_, healthy("one", 100));
    write_golden_case(golden_, healthy("two", 200));
  }
  void TearDown() override { fs::remove_all(root_); }

  static GoldenCase healthy(const std::string& name, int level) {
    GoldenRun run;
    run.scores = {name, "default", 1, {{"registration", "max/rotation_deg@1", "deg", 0.2, "ok", 1}}};
    run.images = {{"result", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(level))}};
    run.steps = {{"capture", "c", "scene"}};
    GoldenCase empty;
    empty.name = name;
    empty.scene = "scenes/one.toml";
    return accepted(empty, run, {"first", {}, {}}).golden;
  }

  // Whether a complaint about `where` says `words`.
  bool says(const std::string& where, const std::string& words, bool grave) const {
    const auto found = examine_goldens(golden_);
    return std::any_of(found.begin(), found.end(), [&](const Complaint& each) {
      return each.where == where && each.grave == grave && each.what.find(words) != std::string::npos;
    });
  }
  fs::path root_, golden_;
};

TEST_F(GateDoctor, HealthyReferencesLackOnlyMeasuredNuisance) {
  const auto found = examine_goldens(golden_);
  ASSERT_EQ(found.size(), 1u) << found.back().where << found.back().what;
  EXPECT_EQ(found[0].where, "nuisance.json");
  EXPECT_FALSE(found[0].grave);
}

TEST_F(GateDoctor, FindsWhatIsMissingCorruptOrStale) {
  fs::remove(golden_ / "one/result.png");
  EXPECT_TRUE(says("one", "missing", true));
  auto stale = healthy("two", 200);
  stale.scene = "scenes/none.toml";
  stale.scores[0].row.metric = "max/wobble_deg@1";
  stale.known_misses["open top/loops@9"] = "why";
  write_golden_case(golden_, stale);
  EXPECT_TRUE(says("two", "scenes/none.toml is missing", true));
  EXPECT_TRUE(says("two", "max/wobble_deg@1", true));
  EXPECT_TRUE(says("two", "known miss of \"open top/loops@9\"", true));
}

TEST_F(GateDoctor, FindsPicturesThatCannotBeToldApart) {
  write_golden_case(golden_, healthy("two", 100));
  EXPECT_TRUE(says("images", "cannot be told apart", true));
}

TEST_F(GateDoctor, FindsWhatCreptAndWhatNobodyReads) {
  auto crept = healthy("one", 100);
  crept.scores[0].first = 0.16;  // two tolerances of 0.02 better than now
  crept.steps.clear();
  write_golden_case(golden_, crept);
  std::ofstream(golden_ / "one/first.png") << "x";
  EXPECT_TRUE(says("one", "crept from 0.16 to 0.2", false));
  EXPECT_TRUE(says("one", "no bytes kept", false));
  EXPECT_TRUE(says("one", "nobody reads first.png", false));
}

TEST_F(GateDoctor, NoReferencesAtAllAreGrave) {
  fs::remove_all(golden_);
  const auto found = examine_goldens(golden_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].grave);
}

}  // namespace
}  // namespace dressform
