// Feeds bytes to the reader of OBJ meshes.
#include "scenes/mesh_io.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const dressform::FuzzFile file("a.obj");
  return file.feed(data, size, [](const std::filesystem::path& path) { dressform::read_mesh_as_it_looks(path); });
}
