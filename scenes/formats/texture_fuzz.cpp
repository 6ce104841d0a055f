// Feeds bytes to the decoder of textures.
#include "scenes/image_file.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    dressform::decode_texture("image", std::string(reinterpret_cast<const char*>(data), size));
  } catch (const dressform::InputError&) {
  }
  return 0;
}
