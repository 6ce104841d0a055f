#include "synthetic/garments/weave.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/random.h"

namespace dressform {

cv::Mat smooth_noise(const cv::Size& size, double across_px, double down_px, Seed seed, std::uint64_t stream) {
  const int w = std::max(2, static_cast<int>(std::ceil(size.width / across_px)) + 1);
  const int h = std::max(2, static_cast<int>(std::ceil(size.height / down_px)) + 1);
  cv::Mat coarse(h, w, CV_32F);
  float* values = coarse.ptr<float>();
  const size_t count = static_cast<size_t>(w) * h;
  for (size_t i = 0; i < count; i += 4) {
    const auto n = normal4(seed, stream, i / 4);
    for (size_t k = 0; k < 4 && i + k < count; ++k) values[i + k] = static_cast<float>(n[k]);
  }
  cv::Mat fine;
  cv::resize(coarse, fine, size, 0, 0, cv::INTER_LINEAR);
  return fine;
}

cv::Mat woven(const cv::Mat& print, double pixels_per_m, double yarn_contrast, double dye_contrast, Seed seed) {
  const auto grain = [&](double across_m, double down_m, const char* name) {
    return smooth_noise(print.size(), std::max(1.0, across_m * pixels_per_m), std::max(1.0, down_m * pixels_per_m),
                        seed, stream_of(name));
  };
  cv::Mat factor = grain(0.001, 0.020, "warp") + grain(0.020, 0.001, "weft");
  factor = 1 + 0.7 * yarn_contrast * factor + dye_contrast * grain(0.05, 0.06, "dye");
  cv::Mat three, values, result;
  cv::merge(std::vector<cv::Mat>{factor, factor, factor}, three);
  print.convertTo(values, CV_32F);
  cv::Mat(values.mul(three)).convertTo(result, CV_8U);
  return result;
}

}  // namespace dressform
