#include "eval/run/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scenes/error.h"
#include "scenes/temporary_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / "run_folder";
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  static std::string refusal(const fs::path& folder) {
    try {
      RunFolder opened(folder);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  fs::path root_;
};

TEST_F(RunFolderTest, TwoRunsDoNotWriteIntoOneFolder) {
  {
    RunFolder first(root_ / "run");
    EXPECT_THAT(refusal(root_ / "run"), HasSubstr("another run is writing into this folder"));
    EXPECT_EQ(refusal(root_ / "other"), "");
  }
  EXPECT_EQ(refusal(root_ / "run"), "") << "the first one has ended";
}

TEST_F(RunFolderTest, AFolderThatHoldsOtherThingsIsRefused) {
  fs::create_directories(root_ / "full");
  std::ofstream(root_ / "full/notes.txt") << "kept";
  EXPECT_THAT(refusal(root_ / "full"), HasSubstr("is not empty and holds no run.json"));
  std::ofstream(root_ / "file") << "kept";
  EXPECT_THAT(refusal(root_ / "file"), HasSubstr("is a file"));
  EXPECT_THAT(refusal(root_ / "file/run"), HasSubstr("is a file; expected a folder to put the run in"));
  EXPECT_THAT(refusal("/proc/run"), HasSubstr("-o /proc/run: "));
}

// Killed while it wrote the very first file.
TEST_F(RunFolderTest, HalfARunJsonIsNoOtherThing) {
  fs::create_directories(root_ / "run");
  std::ofstream(temporary_beside(root_ / "run/run.json")) << "{";
  EXPECT_EQ(refusal(root_ / "run"), "");
}

}  // namespace
}  // namespace dressform
