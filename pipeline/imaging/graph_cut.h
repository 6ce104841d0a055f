#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

// Smoothness of a cut: neighbours pay strength * exp(-|colour difference|^2 / (2 sigma^2)) / distance for different
// labels, sigma^2 being half the mean squared difference in the active region (Boykov and Jolly, ICCV 2001).
struct CutSmoothness {
  double strength = 6;
  double floor = 0.05;  // the least part of `strength` that is paid even across a strong edge
};

// Two labels by minimum cut on the 8-connected grid. Deterministic.
// color: 8-bit, 3 channels (a perceptual space); ones_cost: float32, cost of label 255 less cost of label 0;
// active: uint8, 0 = the pixel keeps its label from `initial` and holds its active neighbours to it;
// initial: uint8, 0 or 255. Returns uint8, 0 or 255.
cv::Mat binary_cut(const cv::Mat& color, const cv::Mat& ones_cost, const cv::Mat& active, const cv::Mat& initial,
                   const CutSmoothness& smoothness = {});

}  // namespace dressform
