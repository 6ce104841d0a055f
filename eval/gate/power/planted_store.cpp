#include "eval/gate/power/planted_store.h"

#include <stdexcept>

namespace dressform {

namespace fs = std::filesystem;

void plant_artifact(const fs::path& store, const std::vector<StageRecord>& records, const std::string& label,
                    const std::function<std::string(const std::string&)>& edit, const fs::path& planted) {
  const ArtifactStore from(store);
  ArtifactStore to(planted);
  bool found = label.empty();
  for (const auto& record : records) {
    const auto artifact = from.find(record.recipe);
    if (!artifact) throw std::runtime_error(from.folder(record.recipe).string() + ": gone while it was in use");
    if (record.label == label) {
      to.save(record.recipe, edit(from.load(*artifact)), artifact->seconds, artifact->peak_memory_mb);
      found = true;
      continue;
    }
    fs::create_directories(to.folder(record.recipe).parent_path());
    if (!fs::exists(to.folder(record.recipe)))  // two labels may be one artifact
      fs::create_directory_symlink(from.folder(record.recipe), to.folder(record.recipe));
  }
  if (!found) throw std::logic_error("the run has no stage " + label);
}

}  // namespace dressform
