// What a store may hold under an artifact's name: the first byte chooses between its record (artifact.json) and the
// bytes of a result, of a few stages that are read by hand nowhere else.
#include "pipeline/extract/extract.h"
#include "pipeline/landmarks/landmarks.h"
#include "pipeline/open/open.h"
#include "pipeline/registration/registration.h"
#include "pipeline/run/artifact_store.h"
#include "scenes/serialize.h"
#include "scenes/testing/fuzz_file.h"

namespace {

using namespace dressform;

void read_record(const std::uint8_t* data, std::size_t size) {
  static const ArtifactStore store(fuzz_folder("store"));
  static const Recipe recipe{"fuse", "tsdf", "v1", {{"voxel_m", 0.004}}, 7, {"aa", "bb"}};
  static const auto folder = store.folder(recipe);
  static const std::uint8_t bytes[] = "the bytes";
  write_fuzzed(folder / "data.bin", bytes, sizeof bytes - 1);
  write_fuzzed(folder / "artifact.json", data, size);
  if (const auto found = store.find(recipe)) store.load(*found);
}

template <class T>
void read_result(const std::string& bytes) {
  try {
    from_bytes<T>(bytes);
  } catch (const std::runtime_error&) {  // truncated, too long or damaged: an answer
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  switch (data[0] % 5) {
    case 0:
      expect_answer([&] { read_record(data + 1, size - 1); });
      break;
    case 1:
      read_result<Registration>(bytes);
      break;
    case 2:
      read_result<OpenGarments>(bytes);
      break;
    case 3:
      read_result<Landmarks>(bytes);
      break;
    case 4:
      read_result<ExtractedViews>(bytes);
      break;
  }
  return 0;
}
