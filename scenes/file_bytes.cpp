#include "scenes/file_bytes.h"

#include <fstream>

#include "scenes/error.h"
#include "scenes/temporary_files.h"

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
  remove_stale_temporaries(folder, std::chrono::seconds(0));
}

void write_file_atomically(const std::filesystem::path& path, const std::string& bytes) {
  const std::filesystem::path temporary = temporary_beside(path);
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
