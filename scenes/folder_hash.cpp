#include "scenes/folder_hash.h"

#include <algorithm>
#include <vector>

#include "scenes/hash.h"

namespace dressform {

namespace fs = std::filesystem;

std::string hash_folder(const fs::path& folder) {
  std::vector<std::string> names;
  if (fs::is_directory(folder))
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
      if (entry->path().filename().string()[0] == '.')
        entry.disable_recursion_pending();
      else if (entry->is_regular_file())
        names.push_back(entry->path().lexically_relative(folder).generic_string());
    }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const auto& name : names) text += name + '\0' + hash_file(folder / name) + '\n';
  return hash_hex(text);
}

}  // namespace dressform
