#pragma once
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "scenes/error.h"

namespace dressform {

// The bytes of a fuzz program as a file, in a folder that goes with the program.
class FuzzFile {
 public:
  explicit FuzzFile(const std::string& name)
      : folder_(std::filesystem::temp_directory_path() / ("dressform_fuzz_" + name + std::to_string(getpid()))),
        path_(folder_ / name) {
    std::filesystem::create_directories(folder_);
  }
  ~FuzzFile() { std::filesystem::remove_all(folder_); }

  // Writes the bytes and calls read(path): an InputError is the right answer to what is wrong, anything else a finding.
  template <class ReadFile>
  int feed(const std::uint8_t* data, std::size_t size, const ReadFile& read) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
      read(path_);
    } catch (const InputError&) {
    }
    return 0;
  }

 private:
  std::filesystem::path folder_, path_;
};

}  // namespace dressform
