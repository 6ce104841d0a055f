#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dressform {

// A picture of the report: written as renders/<name>.png.
struct Figure {
  std::string name;     // file stem
  std::string title;    // a few words
  std::string caption;  // what is to be seen, with units
  cv::Mat picture;      // 8-bit BGR
};

// Pictures side by side, all brought to `height` pixels, `gap` white pixels between them.
cv::Mat side_by_side(const std::vector<cv::Mat>& pictures, int height, int gap = 6);
// Pictures below one another, brought to the width of the widest by white margins.
cv::Mat stacked(const std::vector<cv::Mat>& pictures, int gap = 6);
// The part of a picture around the mask's bounding box, with a margin of `margin` of its size; all of it when empty.
cv::Rect box_around(const cv::Mat& mask, double margin);
// Tints pixels where `mask` is not 0 with `bgr`.
cv::Mat tinted(const cv::Mat& picture, const cv::Mat& mask, const cv::Scalar& bgr, double strength = 0.45);
// Depth (uint16 mm) in colours, near warm, far cold, 0 black.
cv::Mat depth_picture(const cv::Mat& depth_mm, double nearest_m, double farthest_m);
// Infrared (uint16) as grey, stretched to its 99th percentile.
cv::Mat infrared_picture(const cv::Mat& ir);
// A line of text in a white strip above the picture.
cv::Mat titled(const cv::Mat& picture, const std::string& text);

}  // namespace dressform
