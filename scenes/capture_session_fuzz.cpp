// session.json of a capture session: all that it says is read, images are not opened.
#include "scenes/capture_session.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto folder = dressform::fuzz_folder("session");
  static const std::string camera = R"({"width": 32, "height": 26, "fx": 23, "fy": 23, "cx": 15.5, "cy": 12.5,
    "distortion": [0, 0, 0, 0, 0]})";
  static const std::string calibration =
      R"({"format": "dressform-calibration", "version": 1, "sensors": {"k1": {"ir": )" + camera +
      R"(}, "k2": {"ir": )" + camera + "}}}";
  dressform::write_fuzzed(folder / "calibration.json", calibration);
  dressform::write_fuzzed(folder / "session.json", data, size);
  dressform::expect_answer([] { dressform::read_session_outline(folder); });
  return 0;
}
