#pragma once
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "scenes/error.h"

namespace dressform {

// What fuzz targets of readers of folders share: a folder of this process, in which one file holds the fuzzer's bytes.
inline std::filesystem::path fuzz_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / (name + "_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

inline void write_fuzzed(const std::filesystem::path& file, const std::uint8_t* data, std::size_t size) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

// Runs a reader: an InputError is an answer, anything else a finding.
template <class Read>
void expect_answer(Read read) {
  try {
    read();
  } catch (const InputError&) {
  }
}

}  // namespace dressform
