#include "eval/run/stage_folders.h"

#include <fmt/format.h>

#include <set>

namespace dressform {

namespace fs = std::filesystem;

std::string stage_folder_name(const StageRecord& record) {
  return fmt::format("{:02}_{}", record.number, record.label);
}

void write_stage_folders(const fs::path& stages, const std::vector<StageRecord>& records, const ArtifactStore& store) {
  std::set<std::string> names;
  for (const auto& record : records) names.insert(stage_folder_name(record));
  if (fs::exists(stages))
    for (const auto& entry : fs::directory_iterator(stages))
      if (!names.count(entry.path().filename().string())) fs::remove_all(entry.path());
  for (const auto& record : records) {
    const fs::path folder = stages / stage_folder_name(record), source = store.folder(record.recipe);
    fs::create_directories(folder);
    fs::copy_file(source / "artifact.json", folder / "artifact.json", fs::copy_options::overwrite_existing);
    fs::remove(folder / "data.bin");
    fs::create_symlink(fs::relative(source / "data.bin", fs::absolute(folder)), folder / "data.bin");
  }
}

}  // namespace dressform
