#include "scenes/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

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
  remove_stale_temporaries(folder);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(running));
  EXPECT_TRUE(fs::exists(folder / "notes.tmp"));
  EXPECT_TRUE(fs::exists(folder / "top.ply"));
}

}  // namespace
}  // namespace dressform
