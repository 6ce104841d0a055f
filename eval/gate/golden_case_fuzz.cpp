// golden.json of an accepted case; its image is there.
#include <opencv2/core.hpp>

#include "eval/gate/golden_case.h"
#include "scenes/image_file.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto golden = [] {
    const auto folder = dressform::fuzz_folder("golden");
    std::filesystem::create_directories(folder / "case");
    dressform::write_png(folder / "case/top.png", cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3)));
    return folder;
  }();
  dressform::write_fuzzed(golden / "case/golden.json", data, size);
  try {
    dressform::read_golden_case(golden, "case");
  } catch (const dressform::GoldenError&) {  // exit code 3: an answer
  }
  return 0;
}
