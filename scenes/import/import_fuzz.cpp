// The text files of recordings: the first byte chooses which, the others are its content.
#include <opencv2/core.hpp>

#include "scenes/image_file.h"
#include "scenes/import/import.h"
#include "scenes/testing/fuzz_file.h"

namespace {

struct Target {
  const char *format, *file;
};
const Target kTargets[] = {{"tum", "depth.txt"},
                           {"redwood", "intrinsic.json"},
                           {"bop", "scene_camera.json"},
                           {"azure_kinect", "calibration.json"},
                           {"iai_kinect2", "calib_ir.yaml"},
                           {"generic", "layout.toml"}};

std::filesystem::path recording() {
  const auto folder = dressform::fuzz_folder("recording");
  const cv::Mat depth(288, 320, CV_16UC1, cv::Scalar(1500));
  std::filesystem::create_directories(folder / "depth");
  dressform::write_png(folder / "depth/0.png", depth);
  dressform::write_png(folder / "0000_sync_depth.png", depth);
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto folder = recording();
  if (size == 0) return 0;
  const Target& target = kTargets[data[0] % std::size(kTargets)];
  dressform::write_fuzzed(folder / target.file, data + 1, size - 1);
  dressform::expect_answer([&] {
    dressform::FieldValues values;
    if (std::string(target.format) == "generic") values["layout"] = (folder / target.file).string();
    dressform::Importer::at(target.format).run(folder, dressform::RecordingUse::scan, values, 0);
  });
  return 0;
}
