#include "scenes/file_bytes.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <fstream>

#include "scenes/error.h"

namespace dressform {

std::string read_file_bytes(const std::filesystem::path& path, std::size_t most_bytes) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path.string(), "found no such file; expected a file");
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(path.string(), "found a folder or device; expected a file");
  std::ifstream file(path, std::ios::binary);
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError(path.string(), "cannot be read; expected a readable file");
  if (size > most_bytes)
    throw InputError(path.string(),
                     "found " + std::to_string(size) + " bytes; expected " + std::to_string(most_bytes) + " at most");
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file || file.gcount() != static_cast<std::streamsize>(bytes.size()))
    throw InputError(path.string(), "cannot be read; expected a readable file");
  return bytes;
}

void remove_stale_temporaries(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.rfind(".tmp");
    if (at == std::string::npos || name.find('-', at) == std::string::npos) continue;
    const long writer = std::strtol(name.c_str() + at + 4, nullptr, 10);
    if (writer > 0 && kill(static_cast<pid_t>(writer), 0) != 0 && errno == ESRCH)
      std::filesystem::remove(entry.path(), error);
  }
}

void write_file_atomically(const std::filesystem::path& path, const std::string& bytes) {
  static std::atomic<unsigned> serial{0};  // two threads may write beside one another
  std::filesystem::path temporary = path;
  temporary += ".tmp" + std::to_string(getpid()) + "-" + std::to_string(serial++);
  std::error_code error;
  {
    std::ofstream file(temporary, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (file) std::filesystem::rename(temporary, path, error);
    if (file && !error) return;
  }
  std::filesystem::remove(temporary, error);
  throw InputError(path.string(), "cannot be written; expected a folder that exists and has room");
}

}  // namespace dressform
