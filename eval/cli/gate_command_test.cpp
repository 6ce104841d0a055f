#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <opencv2/core.hpp>

#include "eval/gate/accept.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// `dressform gate` as its users call it, where nothing has to be run: what it prints, and its exit codes.
class GateCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(root_);
    fs::create_directories(root_ / "scenes");
    write_file_atomically(root_ / "scenes/one.toml", "x");
    GoldenRun run;
    run.scores = {"one", "default", 1, {{"registration", "max/rotation_deg@1", "deg", 0.2, "ok", 1}}};
    run.images = {{"result", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(90))}};
    run.steps = {{"capture", "c", "scene"}};
    run.environment = {{"compiler", "of another world"}};
    GoldenCase empty;
    empty.name = "one";
    empty.scene = "scenes/one.toml";
    write_golden_case(root_ / "golden", accepted(empty, run, {"first of all", {}, {}}).golden);
  }
  void TearDown() override { fs::remove_all(root_); }

  int gate(const std::string& arguments) const {
    const std::string command =
        "cd " + root_.string() + " && " + DRESSFORM_PROGRAM + " gate " + arguments + " > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string printed() const { return read_file_bytes(root_ / "out.txt") + read_file_bytes(root_ / "err.txt"); }

  fs::path root_ = fs::path(testing::TempDir()) / "gate_command";
};

TEST_F(GateCommand, ListSaysWhatIsKeptAndWhy) {
  ASSERT_EQ(gate("list"), 0) << printed();
  EXPECT_THAT(printed(), HasSubstr("one: scenes/one.toml, scale 1, seed 1; 1 numbers, 1 images"));
  EXPECT_THAT(printed(), HasSubstr("made in another environment"));
  EXPECT_THAT(printed(), HasSubstr("last: first of all"));
}

TEST_F(GateCommand, DoctorEndsWithTheCodeOfABadGoldenWhereOneIs) {
  EXPECT_EQ(gate("doctor"), 0) << printed();
  EXPECT_THAT(printed(), HasSubstr("can be relied on"));
  fs::remove(root_ / "golden/one/result.png");
  EXPECT_EQ(gate("doctor"), 3);
  EXPECT_THAT(printed(), HasSubstr("GRAVE one"));
}

TEST_F(GateCommand, ACheckWithoutReferenceEndsWithThreeAndSaysSoInJunit) {
  fs::resize_file(root_ / "golden/one/golden.json", 20);
  EXPECT_EQ(gate("check one --junit verdicts.xml -q"), 3) << printed();
  EXPECT_THAT(read_file_bytes(root_ / "verdicts.xml"), HasSubstr("errors=\"1\""));
  EXPECT_EQ(gate("check --golden nowhere -q"), 3);
  EXPECT_EQ(gate("run one --golden nowhere -q"), 3);
}

TEST_F(GateCommand, PowerListsItsFaultsAndRefusesOthers) {
  ASSERT_EQ(gate("power --list --faults open.hole"), 0) << printed();
  EXPECT_THAT(printed(), HasSubstr("open.hole"));
  EXPECT_THAT(printed(), HasSubstr("20, 50, 120"));
  EXPECT_EQ(gate("power --faults open.nothing"), 2);
  EXPECT_EQ(gate("power --sizes huge"), 2);
  EXPECT_EQ(gate("nuisance"), 2) << "with nothing else to run there is nothing to measure";
  EXPECT_EQ(gate("accept one"), 2) << "without a reason";
}

}  // namespace
}  // namespace dressform
