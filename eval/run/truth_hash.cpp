#include "eval/run/truth_hash.h"

#include "scenes/folder_hash.h"

namespace dressform {

std::string truth_hash(const std::filesystem::path& session) {
  return std::filesystem::is_directory(session / "truth") ? hash_folder(session / "truth") : "none";
}

}  // namespace dressform
