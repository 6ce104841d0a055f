#include "scenes/folder_hash.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// Relative, sorted: the hash does not depend on the order in which a file system lists its files.
std::vector<std::string> names_below(const fs::path& folder, const std::vector<std::string>& left_out) {
  std::vector<std::string> names;
  if (!fs::is_directory(folder)) return names;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    const bool unwanted = entry.depth() == 0 && std::find(left_out.begin(), left_out.end(), name) != left_out.end();
    if (unwanted || name[0] == '.')
      entry.disable_recursion_pending();
    else if (entry->is_regular_file())
      names.push_back(entry->path().lexically_relative(folder).generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string hash_folder(const fs::path& folder, const std::vector<std::string>& left_out) {
  const auto names = names_below(folder, left_out);
  std::vector<std::string> hashes(names.size());
  tbb::parallel_for(std::size_t(0), names.size(), [&](std::size_t i) { hashes[i] = hash_file(folder / names[i]); });
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += names[i] + '\0' + hashes[i] + '\n';
  return hash_hex(text);
}

}  // namespace dressform
