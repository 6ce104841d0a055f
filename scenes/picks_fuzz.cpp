// What a person picked: the first byte chooses the format, the others are the file's content.
#include "scenes/picks.h"
#include "scenes/testing/fuzz_file.h"

namespace {

const char* const kFiles[] = {"model/rim_top_neck.pp", "k1/rim_top_neck.txt", "k1/color.json", "region_top_k1.json",
                              "region_top_k1.png"};

std::filesystem::path session() {
  const auto folder = dressform::fuzz_folder("picks");
  const std::string camera = R"({"width": 48, "height": 27, "fx": 27, "fy": 27, "cx": 23.5, "cy": 13,
    "distortion": [0, 0, 0, 0, 0]})";
  dressform::write_fuzzed(folder / "calibration.json",
                          R"({"format": "dressform-calibration", "version": 1, "sensors": {"k1": {"ir": )" + camera +
                              R"(, "color": )" + camera +
                              R"(, "color_from_ir": [[1, 0, 0, 0.05], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}}})");
  dressform::write_fuzzed(folder / "session.json",
                          R"({"format": "dressform-session", "version": 1, "name": "fuzz", "sensors": ["k1"],
    "shots": {"naked": [], "dressed": []}, "scans": {}})");
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto folder = session();
  if (size == 0) return 0;
  const auto file = folder / "picks" / kFiles[data[0] % std::size(kFiles)];
  dressform::write_fuzzed(file, data + 1, size - 1);
  dressform::expect_answer([] { dressform::read_picks(folder); });
  std::filesystem::remove(file);
  return 0;
}
