#include "render/color_map.h"

#include <opencv2/imgproc.hpp>

namespace dressform {

cv::Mat scalar_colors() {
  cv::Mat ramp(256, 1, CV_8UC1), colors;
  for (int i = 0; i < 256; ++i) ramp.at<uchar>(i) = static_cast<uchar>(i);
  cv::applyColorMap(ramp, colors, cv::COLORMAP_VIRIDIS);
  return colors;
}

}  // namespace dressform
