#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// 8-bit BGR to 8-bit CIE Lab after a light edge-preserving smoothing against pixel noise: what colour models and cuts
// look at.
cv::Mat smoothed_lab(const cv::Mat& bgr);

// Density of 8-bit three-channel colours on a grid of 32^3 cells, smoothed. Holds any number of modes, so that a print
// is as good as a plain cloth.
class ColorHistogram {
 public:
  ColorHistogram();
  void add(const cv::Vec3b& color, float weight = 1);
  void add(const cv::Mat& colors, const cv::Mat& mask);  // all pixels where mask != 0
  void finish();                                         // smooths; call once after the last add
  double weight() const { return weight_; }
  // Natural logarithm of the density relative to uniform (0 = as likely as in a uniform mixture), with part `outlier`
  // of the mass spread uniformly. 0 everywhere when nothing was added.
  float log_density(const cv::Vec3b& color, float outlier = 0.02f) const;

 private:
  std::vector<float> cells_;
  double weight_ = 0;
};

}  // namespace dressform
