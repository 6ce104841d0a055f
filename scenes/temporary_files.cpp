#include "scenes/temporary_files.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <random>

namespace dressform {
namespace {

// The process that a temporary name is of; 0: it is no such name.
long writer_of(const std::string& name) {
  const std::size_t at = name.rfind(".tmp");
  if (at == std::string::npos || name.find('-', at) == std::string::npos) return 0;
  return std::strtol(name.c_str() + at + 4, nullptr, 10);
}

}  // namespace

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  // Two threads may write beside one another, and on a shared folder two machines with processes of one number.
  static std::atomic<unsigned> serial{std::random_device{}()};
  std::filesystem::path temporary = path;
  temporary += ".tmp" + std::to_string(getpid()) + "-" + std::to_string(serial++);
  return temporary;
}

bool is_temporary_name(const std::string& name) { return writer_of(name) > 0; }

void remove_stale_temporaries(const std::filesystem::path& folder, std::chrono::seconds least_age,
                              const std::string& prefix) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const long writer = writer_of(name);
    if (writer <= 0 || name.compare(0, prefix.size(), prefix) != 0 || kill(static_cast<pid_t>(writer), 0) == 0 ||
        errno != ESRCH)
      continue;
    if (std::filesystem::file_time_type::clock::now() - entry.last_write_time(error) >= least_age)
      std::filesystem::remove_all(entry.path(), error);
  }
}

}  // namespace dressform
