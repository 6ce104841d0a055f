#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// 4-connected pieces of a depth image: neighbours belong together when their depths differ by less than max_jump_mm.
struct DepthComponents {
  cv::Mat labels;          // int32, IR grid: index of the component, -1 = none
  std::vector<int> sizes;  // pixels, by index
};

// depth_mm: float32, 0 = none; allowed: uint8, 0 = leave out. Components are numbered in reading order.
DepthComponents depth_components(const cv::Mat& depth_mm, const cv::Mat& allowed, double max_jump_mm);

}  // namespace dressform
