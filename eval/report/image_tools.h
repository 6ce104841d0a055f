#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dressform {

// An image of the report: written as renders/<name>.png.
struct Figure {
  std::string name;     // file stem
  std::string title;    // a few words
  std::string caption;  // what is to be seen, with units
  cv::Mat image;        // 8-bit BGR
};

// Images side by side, all brought to `height` pixels, `gap` white pixels between them.
cv::Mat side_by_side(const std::vector<cv::Mat>& images, int height, int gap = 6);
// Images below one another, brought to the width of the widest by white margins.
cv::Mat stacked(const std::vector<cv::Mat>& images, int gap = 6);
// The part of an image around the mask's bounding box, with a margin of `margin` of its size; all of it when empty.
cv::Rect box_around(const cv::Mat& mask, double margin);
// Tints pixels where `mask` is not 0 with `bgr`.
cv::Mat tinted(const cv::Mat& image, const cv::Mat& mask, const cv::Scalar& bgr, double strength = 0.45);
// Depth (uint16 mm) in colours, near warm, far cold, 0 black.
cv::Mat depth_image(const cv::Mat& depth_mm, double nearest_m, double farthest_m);
// Infrared (uint16) as grey, stretched to its 99th percentile.
cv::Mat infrared_image(const cv::Mat& ir);
// A line of text in a white strip above the image.
cv::Mat titled(const cv::Mat& image, const std::string& text);

}  // namespace dressform
