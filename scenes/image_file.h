#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace dressform {

// What an image file must hold, named as errors name it.
struct ImageKind {
  int type;               // OpenCV's: CV_16UC1, CV_8UC1, CV_8UC3
  const char* name;       // "a PNG of 16-bit grey"
  bool grey_too = false;  // CV_8UC3: 8-bit grey is read as well, as three equal channels
};
extern const ImageKind kDepthImage, kIndexImage, kColorImage;  // colour: PNG or JPEG
extern const ImageKind kColorOrGreyImage;                      // of other tools' recordings

// Reads a PNG (checked down to its checksums) or JPEG. `size` of 0 x 0 takes any size. Throws InputError naming the
// file and what was found: missing, damaged, another bit depth, channel count or size.
cv::Mat read_image(const std::filesystem::path& file, const ImageKind& kind, cv::Size size = {});

// Fast lossless PNG. Throws InputError when the file cannot be written.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace dressform
