// Feeds bytes to the reader of MTL libraries.
#include "scenes/formats/mtl.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const dressform::FuzzFile file("a.mtl");
  return file.feed(data, size, [](const std::filesystem::path& path) {
    std::map<std::string, dressform::MtlMaterial> materials;
    dressform::read_mtl(path, materials);
  });
}
