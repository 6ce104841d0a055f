#include "eval/run/truth_hash.h"

#include <algorithm>
#include <vector>

#include "scenes/hash.h"

namespace dressform {

namespace fs = std::filesystem;

std::string truth_hash(const fs::path& session) {
  if (!fs::is_directory(session / "truth")) return "none";
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(session / "truth"))
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), session).generic_string());
  std::sort(names.begin(), names.end());
  std::string text;
  for (const auto& name : names) text += name + " " + hash_file(session / name) + "\n";
  return hash_hex(text);
}

}  // namespace dressform
