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

// An image to be laid on a surface.
struct TextureImage {
  cv::Mat bgr;                 // 8-bit BGR
  cv::Mat alpha;               // 8 bits, same size; empty where every pixel is opaque
  cv::Mat brightness() const;  // 8 bits, same size
};

// Decodes a PNG or JPEG of any kind: 16 bits are rounded to 8, grey becomes three equal channels. Pixels stay as they
// are stored, whatever an EXIF orientation says: texture coordinates are counted on them. Throws InputError naming
// `where`: damaged, no PNG or JPEG, larger than 16384 a side or 2^27 pixels (found out before memory is spent on it).
TextureImage decode_texture(const std::string& where, const std::string& bytes);

// Fast lossless PNG. Throws InputError when the file cannot be written.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace dressform
