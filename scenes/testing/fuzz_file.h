#pragma once
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <list>
#include <string>
#include <system_error>

#include "scenes/error.h"

namespace dressform {

// A folder of this process for a fuzz program; it goes when the program ends by itself.
inline std::filesystem::path fuzz_folder(const std::string& name) {
  struct Folder {
    std::filesystem::path path;
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static std::list<Folder> folders;
  folders.push_back({});
  folders.back().path =
      std::filesystem::temp_directory_path() / ("dressform_fuzz_" + name + "_" + std::to_string(getpid()));
  std::filesystem::create_directories(folders.back().path);
  return folders.back().path;
}

inline void write_fuzzed(const std::filesystem::path& file, const std::uint8_t* data, std::size_t size) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}
inline void write_fuzzed(const std::filesystem::path& file, const std::string& text) {
  write_fuzzed(file, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

// Runs a reader: an InputError is the right answer to what is wrong, anything else a finding.
template <class Read>
void expect_answer(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  }
}

// The bytes of a fuzz program as one file.
class FuzzFile {
 public:
  explicit FuzzFile(const std::string& name) : path_(fuzz_folder(name) / name) {}

  // Writes the bytes and calls read(path).
  template <class ReadFile>
  int feed(const std::uint8_t* data, std::size_t size, const ReadFile& read) const {
    write_fuzzed(path_, data, size);
    expect_answer([&] { read(path_); });
    return 0;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace dressform
