#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// Parts of a class map: int32 labels, 1 to count; 0 = none.
struct LabelMap {
  cv::Mat labels;
  int count = 0;
};

// 4-connected pieces of pixels of equal `keys` (int32, 0 = none) and at least least_px pixels, in the order of their
// first pixels.
LabelMap connected_pieces(const cv::Mat& keys, int least_px = 1);

// The smallest region that a scale (1 to 4) is meant for, and the smallest valley at it; pixels.
int least_region_px(int scale);
int least_valley_px(int scale);

// Where regions begin: pieces of low J. For each region the threshold, of six about its mean, that gives most of them.
// j: float32 j_image at `scale`, regions: int32.
LabelMap valleys(const cv::Mat& j, const cv::Mat& regions, int scale);

// The regions that grow from the seeds until nothing of `regions` is left: holes are filled, then at every scale from
// `scale` down pieces of low J that touch one seed alone join it, and at the finest the rest does, lowest J first.
// Regions without a seed stay whole. j: the j_image of every scale from 1 up to `scale`, j[0] the finest.
LabelMap grown(const LabelMap& seeds, const cv::Mat& regions, const std::vector<cv::Mat>& j, int scale);

}  // namespace dressform
