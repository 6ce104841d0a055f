#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

#include "pipeline/reconstruct.h"
#include "scenes/testing/variant_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAreArray;
using testing::IsSupersetOf;
using testing::UnorderedElementsAreArray;

const fs::path kPipeline = fs::path(DRESSFORM_SOURCE_DIR) / "pipeline";

std::vector<std::string> names_of(const StageDescription& stage) {
  std::vector<std::string> names;
  for (const auto& variant : stage.variants) names.push_back(variant.name);
  return names;
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A folder whose header, named like it, declares a stage.
std::vector<std::string> stage_folders() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kPipeline)) {
    const std::string name = entry.path().filename().string();
    if (text_of(entry.path() / (name + ".h")).find(" = Stage<") != std::string::npos) names.push_back(name);
  }
  return names;
}

TEST(Stages, AreTheFoldersThatDeclareOne) {
  std::vector<std::string> described;
  for (const auto& stage : describe_stages()) described.push_back(stage.name);
  EXPECT_THAT(described, UnorderedElementsAreArray(stage_folders()));
}

// A variant that the linker dropped, or that goes by another name than its file, shows here.
TEST(Stages, RegisterTheVariantsOfTheirFiles) {
  for (const auto& stage : describe_stages()) {
    SCOPED_TRACE(stage.name);
    EXPECT_THAT(names_of(stage), ElementsAreArray(variant_files(kPipeline / stage.name)));
    EXPECT_THAT(names_of(stage), Contains(stage.default_variant));
  }
}

// The tables of pipeline/README.md: under "## stage", rows that start with "| `variant`"; the default says so.
struct Documented {
  std::vector<std::string> variants, defaults;
};
std::map<std::string, Documented> documented_stages() {
  std::map<std::string, Documented> stages;
  std::ifstream file(kPipeline / "README.md");
  Documented* stage = nullptr;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("## ", 0) == 0) stage = &stages[line.substr(3)];
    if (!stage || line.rfind("| `", 0) != 0) continue;
    const std::string name = line.substr(3, line.find('`', 3) - 3);
    stage->variants.push_back(name);
    if (line.rfind("| `" + name + "` (default)", 0) == 0) stage->defaults.push_back(name);
  }
  return stages;
}

// A new variant is one file, so that its row may come later; what a row names is there.
TEST(Stages, TheReadmeNamesNoVariantThatIsNotThere) {
  auto documented = documented_stages();
  for (const auto& stage : describe_stages()) {
    SCOPED_TRACE(stage.name);
    EXPECT_THAT(names_of(stage), IsSupersetOf(documented[stage.name].variants));
    EXPECT_THAT(documented[stage.name].defaults, ElementsAreArray({stage.default_variant}));
  }
  EXPECT_EQ(documented.size(), describe_stages().size()) << "a stage that is not there any more";
}

TEST(VariantFiles, AFileThatRegistersAnotherNameIsNamed) {
  const fs::path folder = fs::path(testing::TempDir()) / "variant_files";
  fs::create_directories(folder);
  std::ofstream(folder / "tsdf.cpp") << "const Fuse::Variant variant{\"tsdf\", tsdf};\n";
  std::ofstream(folder / "icp.cpp") << "const Fuse::Variant variant{\n    \"icp_fast\", icp};\n";
  std::ofstream(folder / "tsdf_test.cpp") << "const Fuse::Variant variant{\"planted\", planted};\n";
  EXPECT_THAT(variant_files(folder), ElementsAreArray({"icp.cpp: icp_fast", "tsdf"}));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dressform
