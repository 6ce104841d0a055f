#include "eval/run/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

ChildResult run_line(const std::string& line, double limit_seconds = 60) {
  const fs::path folder = fs::path(testing::TempDir()) / "child_process";
  fs::create_directories(folder);
  return run_child({line, folder, limit_seconds, folder / "output.txt", folder / "log.txt"});
}

TEST(ChildProcess, GivesExitCodeAndComplaint) {
  const auto result = run_line("echo result; echo first >&2; echo 'no such body' >&2; exit 3");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_FALSE(result.good());
  EXPECT_EQ(result.end_text(), "exit code 3");
  EXPECT_EQ(result.complaint, "first\nno such body");
  EXPECT_EQ(read_file_bytes(fs::path(testing::TempDir()) / "child_process/output.txt"), "result\n");
  EXPECT_TRUE(run_line("true").good());
  EXPECT_EQ(run_line("no_such_program_anywhere").exit_code, 127);
}

TEST(ChildProcess, OfALongComplaintTheEndIsKept) {
  const auto result = run_line("for i in $(seq 1 1000); do echo line $i >&2; done; exit 1");
  EXPECT_LE(result.complaint.size(), 2000u);
  EXPECT_EQ(result.complaint.substr(0, 5), "line ");
  EXPECT_NE(result.complaint.find("line 1000"), std::string::npos);
}

TEST(ChildProcess, EndsAtItsLimitWithAllThatItStarted) {
  const auto result = run_line("sleep 1000 & echo $! ; sleep 1000", 0.2);
  EXPECT_TRUE(result.timed_out);
  EXPECT_FALSE(result.good());
  EXPECT_NE(result.end_text().find("no end after"), std::string::npos);
  const int background = std::stoi(read_file_bytes(fs::path(testing::TempDir()) / "child_process/output.txt"));
  const fs::path program = fs::path("/proc") / std::to_string(background) / "exe";  // of a dead one there is none
  for (int i = 0; i < 200 && fs::exists(program); ++i) usleep(10000);
  EXPECT_FALSE(fs::exists(program));
}

TEST(ChildProcess, NamesTheSignal) { EXPECT_EQ(run_line("kill -9 $$").end_text(), "signal 9 (Killed)"); }

TEST(ChildProcess, AWordIsOneWordWhateverItHolds) {
  const std::string text = "it's; $HOME `x` \"y\" *";
  run_line("printf %s " + shell_word(text));
  EXPECT_EQ(read_file_bytes(fs::path(testing::TempDir()) / "child_process/output.txt"), text);
  EXPECT_THROW(run_child({"true", "/", 1, "/no/such/folder/output", "/no/such/folder/log"}), InputError);
}

}  // namespace
}  // namespace dressform
