#include "eval/studies/shared_file.h"

#include <gtest/gtest.h>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

TEST(SharedFile, IsWholeAndAlone) {
  const fs::path folder = fs::path(testing::TempDir()) / "shared_file";
  fs::remove_all(folder);
  fs::create_directories(folder);
  EXPECT_FALSE(can_be_opened(folder / "cell.json"));
  const std::string bytes(300000, 'x');
  write_file_durably(folder / "cell.json", "before");
  write_file_durably(folder / "cell.json", bytes);
  EXPECT_TRUE(can_be_opened(folder / "cell.json"));
  EXPECT_EQ(read_file_bytes(folder / "cell.json"), bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);  // nothing temporary is left
  EXPECT_THROW(write_file_durably(folder / "nowhere/cell.json", bytes), InputError);
}

}  // namespace
}  // namespace dressform
