// The gate's files: golden.json of an accepted case, whose image is there; nuisance.json; observed.json of a run.
#include <opencv2/core.hpp>

#include "eval/gate/golden_run.h"
#include "eval/gate/nuisance.h"
#include "scenes/image_file.h"
#include "scenes/testing/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto golden = [] {
    const auto folder = dressform::fuzz_folder("golden");
    std::filesystem::create_directories(folder / "case");
    dressform::write_png(folder / "case/top.png", cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3)));
    return folder;
  }();
  for (const char* file : {"case/golden.json", "nuisance.json", "case/observed.json"})
    dressform::write_fuzzed(golden / file, data, size);
  try {
    dressform::read_golden_case(golden, "case");
  } catch (const dressform::GoldenError&) {  // exit code 3: an answer
  }
  try {
    dressform::read_nuisance(golden);
  } catch (const dressform::GoldenError&) {
  }
  dressform::expect_answer([] { dressform::read_golden_run(golden / "case"); });
  return 0;
}
