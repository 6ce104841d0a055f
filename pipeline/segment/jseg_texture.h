#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

constexpr int kJsegScales = 4;  // 1 to 4: windows of 9, 17, 33, 65 pixels
constexpr float kMostJ = 2;     // larger values, and those of classes that do not spread at all, are this one

// How unevenly classes lie about each pixel: J = (S_T - S_W) / S_W of the positions in a round window of 61 samples,
// S_T their scatter about their mean, S_W about the means of their classes. 0 in a texture that looks alike all over,
// high where two of them meet. Samples lie 2^(scale - 1) pixels apart; those beyond the image's border repeat it, those
// of another region than the window's middle do not count. At scales above 1 the image is smoothed twice, within
// regions. classes: int32, 0 to class_count - 1; regions: int32, 0 = left out (J = 0). float32. Deng and Manjunath,
// "Unsupervised segmentation of color-texture regions in images and video", PAMI 2001.
cv::Mat j_image(const cv::Mat& classes, int class_count, const cv::Mat& regions, int scale);

// The same measure of a whole class map at once.
double j_of(const cv::Mat& classes);

}  // namespace dressform
