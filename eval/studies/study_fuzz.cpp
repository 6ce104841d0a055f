// Feeds bytes to the reader of study files.
#include "eval/studies/study.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const dressform::FuzzFile file("a.toml");
  return file.feed(data, size, [](const std::filesystem::path& path) { dressform::read_study(path); });
}
