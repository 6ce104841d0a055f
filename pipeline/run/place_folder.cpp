#include "pipeline/run/place_folder.h"

#include "scenes/temporary_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A temporary folder beside `target`: hidden, and gone when this is, unless it was renamed.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& target)
      : path_(temporary_beside(target.parent_path() / ("." + target.filename().string()))) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

constexpr std::chrono::minutes kStale{10};  // no artifact takes that long to write

}  // namespace

void place_folder(const fs::path& target, const std::function<void(const fs::path&)>& fill,
                  const std::function<bool()>& intact) {
  fs::create_directories(target.parent_path());
  remove_stale_temporaries(target.parent_path(), kStale);
  const TemporaryFolder made(target), damaged(target);
  fs::create_directory(made.path());
  fill(made.path());
  std::error_code error;
  fs::rename(made.path(), target, error);
  if (!error) return;
  if (!fs::exists(target)) throw fs::filesystem_error("cannot be put in place", made.path(), target, error);
  if (intact()) return;
  fs::rename(target, damaged.path());
  fs::rename(made.path(), target);
}

}  // namespace dressform
