#include "scenes/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "scenes/temporary_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

TEST(FileBytes, WhatKilledWritersLeftIsTakenAway) {
  const fs::path folder = fs::path(testing::TempDir()) / "file_bytes";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const pid_t gone = fork();
  if (gone == 0) _exit(0);
  waitpid(gone, nullptr, 0);
  const fs::path left = folder / ("top.ply.tmp" + std::to_string(gone) + "-3");
  const fs::path running = folder / ("top.ply.tmp" + std::to_string(getpid()) + "-3");
  for (const fs::path& path : {left, running, folder / "notes.tmp", folder / "top.ply"}) std::ofstream(path) << "x";
  const fs::path other = folder / ("bottom.tmp" + std::to_string(gone) + "-0");  // a folder, with something in it
  fs::create_directories(other / "session");
  std::ofstream(other / "session/depth.png") << "x";
  remove_stale_temporaries(folder, std::chrono::hours(1));
  remove_stale_temporaries(folder, std::chrono::seconds(0), "hat");
  EXPECT_TRUE(fs::exists(left) && fs::exists(other)) << "too young, or another's";
  remove_stale_temporaries(folder);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(other));
  EXPECT_TRUE(fs::exists(running));
  EXPECT_TRUE(fs::exists(folder / "notes.tmp"));
  EXPECT_TRUE(fs::exists(folder / "top.ply"));
}

TEST(FileBytes, TemporaryNamesAreToldFromOthers) {
  const fs::path first = temporary_beside("out/top.ply"), second = temporary_beside("out/top.ply");
  EXPECT_NE(first, second);
  EXPECT_EQ(first.parent_path(), "out");
  EXPECT_TRUE(is_temporary_name(first.filename().string()));
  for (const char* name : {"top.ply", "notes.tmp", "top.tmp-1", ".tmp", ""}) EXPECT_FALSE(is_temporary_name(name));
}

}  // namespace
}  // namespace dressform
