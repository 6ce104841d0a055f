#include "scenes/new_folder.h"

#include <unistd.h>

#include "scenes/error.h"

namespace dressform {

namespace fs = std::filesystem;

NewFolder::NewFolder(const fs::path& folder) : target_(fs::absolute(folder).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // "out/" means "out"
  if (fs::exists(target_)) throw InputError(folder.string(), "is there already; expected a new folder");
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  temporary_ =
      target_.parent_path() / (".new_" + target_.filename().string() + "_" + std::to_string(getpid()) + ".part");
  fs::remove_all(temporary_, error);
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
