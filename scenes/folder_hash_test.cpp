#include "scenes/folder_hash.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

class FolderHash : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / "folder_hash";
    fs::remove_all(folder_);
    for (int i = 0; i < 9; ++i) put("sub/" + std::to_string(i), std::string(static_cast<std::size_t>(i), 'x'));
    put("truth/mesh", "true");
    put("sub/truth", "not the folder's own");
  }
  void TearDown() override { fs::remove_all(folder_); }
  void put(const std::string& name, const std::string& bytes) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  fs::path folder_;
};

TEST_F(FolderHash, IsThatOfNamesAndBytes) {
  const std::string before = hash_folder(folder_);
  EXPECT_EQ(hash_folder(folder_), before);
  fs::rename(folder_ / "sub/8", folder_ / "sub/9");
  EXPECT_NE(hash_folder(folder_), before);
  fs::rename(folder_ / "sub/9", folder_ / "sub/8");
  EXPECT_EQ(hash_folder(folder_), before);
  put("sub/8", "xxxxxxxy");
  EXPECT_NE(hash_folder(folder_), before);
}

TEST_F(FolderHash, OfOneFileIsKnown) {
  fs::remove_all(folder_);
  EXPECT_EQ(hash_folder(folder_), hash_hex("")) << "no such folder";
  put("a", "b");
  EXPECT_EQ(hash_folder(folder_), hash_hex(std::string("a\0", 2) + hash_hex("b") + "\n"));
}

TEST_F(FolderHash, LeavesOutWhatIsAskedForAndHiddenFiles) {
  const std::string whole = hash_folder(folder_), without = hash_folder(folder_, {"truth", "picks"});
  EXPECT_NE(whole, without);
  put("truth/mesh", "changed");
  EXPECT_EQ(hash_folder(folder_, {"truth", "picks"}), without);
  put("sub/truth", "changed");
  EXPECT_NE(hash_folder(folder_, {"truth", "picks"}), without) << "only what lies in the folder itself is left out";
  const std::string visible = hash_folder(folder_);
  put("sub/.half.tmp", "?");
  put(".hidden/file", "?");
  EXPECT_EQ(hash_folder(folder_), visible);
}

}  // namespace
}  // namespace dressform
