#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>

namespace dressform {

// The shapes of a labelme file (JSON) of an image of `size`, drawn as masks (uint8, 255 inside), by label: polygons and
// rectangles, in labelme's coordinates (0 at the outer edge of the first pixel). Throws InputError naming file and
// field: an image of another size, another kind of shape, points outside the image.
std::map<std::string, cv::Mat> read_labelme(const std::filesystem::path& file, cv::Size size);

// A PNG of 8-bit grey of `size`: 0 outside, everything else inside. Throws InputError naming the file.
cv::Mat read_mask(const std::filesystem::path& file, cv::Size size);

}  // namespace dressform
