#pragma once
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "synthetic/sensors/known_scenes.h"

namespace dressform {

// Infrared camera of a Kinect v2 at half its size.
inline Camera half_size_kinect() { return Camera{256, 212, 183, 183, 127.5, 105.5, {0.09, -0.27, 0, 0, 0.1}}; }

// Depth of a tilted plane with so much noise of its own in every pixel.
inline cv::Mat noisy_plane(double distance_m, double tilt_deg, double sigma_mm, int stream) {
  cv::Mat noise(half_size_kinect().height, half_size_kinect().width, CV_64F), depth(noise.size(), CV_16UC1);
  cv::RNG(static_cast<std::uint64_t>(stream)).fill(noise, cv::RNG::NORMAL, 0, sigma_mm);
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      const double mm =
          1000 * true_plane_depth(half_size_kinect(), x, y, distance_m, tilt_deg) + noise.at<double>(y, x);
      depth.at<std::uint16_t>(y, x) = mm > 300 && mm < 8000 ? static_cast<std::uint16_t>(std::lround(mm)) : 0;
    }
  return depth;
}

}  // namespace dressform
