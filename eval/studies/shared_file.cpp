#include "eval/studies/shared_file.h"

#include <fcntl.h>
#include <unistd.h>

#include "scenes/error.h"
#include "scenes/temporary_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

bool write_all(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

// A folder's names on the disk; where the file system does not do that for folders, the rename has to do.
void sync_folder(const fs::path& folder) {
  const int opened = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  fsync(opened);
  close(opened);
}

}  // namespace

void write_file_durably(const fs::path& path, const std::string& bytes) {
  const fs::path temporary = temporary_beside(path);
  const int file = open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0644);
  bool good = file >= 0 && write_all(file, bytes) && fsync(file) == 0;
  if (file >= 0) good = close(file) == 0 && good;
  std::error_code error;
  if (good) fs::rename(temporary, path, error);
  if (good && !error) return sync_folder(path.parent_path());
  fs::remove(temporary, error);
  throw InputError(path.string(), "cannot be written; expected a folder that exists and has room");
}

bool can_be_opened(const fs::path& file) {
  const int opened = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return false;
  close(opened);
  return true;
}

}  // namespace dressform
