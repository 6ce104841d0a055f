#pragma once
#include <opencv2/core/types.hpp>
#include <vector>

namespace dressform {

struct Packing {
  cv::Size size;
  std::vector<cv::Point> at;  // top left corner of every box
};

// Boxes in a nearly square sheet, none overlapping and none turned: tallest first, each as high up as it goes
// (bottom-left rule on the skyline). Deterministic.
Packing pack(const std::vector<cv::Size>& boxes);

}  // namespace dressform
