#include "scenes/new_folder.h"

#include "scenes/error.h"
#include "scenes/temporary_files.h"

namespace dressform {

namespace fs = std::filesystem;

NewFolder::NewFolder(const fs::path& folder) : target_(fs::absolute(folder).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // "out/" means "out"
  if (fs::exists(target_)) throw InputError(folder.string(), "is there already; expected a new folder");
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  const std::string hidden = "." + target_.filename().string();
  remove_stale_temporaries(target_.parent_path(), std::chrono::seconds(0), hidden + ".tmp");
  temporary_ = temporary_beside(target_.parent_path() / hidden);
  if (error || !fs::create_directory(temporary_, error))
    throw InputError(folder.string(), "cannot be written; expected a writable folder above it");
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  if (!kept_) fs::remove_all(temporary_, ignored);
}

void NewFolder::keep() {
  fs::rename(temporary_, target_);
  kept_ = true;
}

}  // namespace dressform
