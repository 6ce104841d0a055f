// calibration.json, and a skeleton's JSON values by the way.
#include "scenes/calibration_json.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = dressform::fuzz_folder("calibration") / "calibration.json";
  dressform::write_fuzzed(file, data, size);
  dressform::expect_answer([] { dressform::read_calibration(file); });
  return 0;
}
