#pragma once
// For the tests of multipath: simple depth images, and the bounced light in them.
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/multipath/bounce_field.h"
#include "pipeline/multipath/bounce_pixels.h"
#include "pipeline/testing/test_scene.h"

namespace dressform::multipath_test {

constexpr double kSignal = 1300, kAlbedo = 0.5;

inline SensorCalibration plain_kinect() {
  SensorCalibration sensor = test_scene::kinect(1);
  sensor.ir.distortion = {};
  return sensor;
}

// Depth of a scene given by z(ray), millimetres.
template <class Depth>
cv::Mat image_of(const DepthOptics& optics, const Depth& depth_m) {
  cv::Mat image(optics.calibration.ir.height, optics.calibration.ir.width, CV_16U);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto& ray = optics.rays.at<cv::Vec2d>(y, x);
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(std::lround(1000 * depth_m(ray[0], ray[1], x, y)));
    }
  return image;
}

inline std::vector<float> even(const SurfaceCells& cells, double albedo) {
  std::vector<float> result(cells.count(), 0.0f);
  for (int i = 0; i < cells.count(); ++i)
    if (cells.z[i] > 0) result[i] = static_cast<float>(albedo);
  return result;
}

inline BouncedLight light_of(const SurfaceCells& cells) { return bounced_light(cells, even(cells, kAlbedo)); }
inline std::vector<float> errors_of(const SurfaceCells& cells) { return bounce_errors_m(cells, light_of(cells)); }

// One of four places round the figure.
inline Isometry3d stand(int k) {
  const double angle = M_PI / 2 * k + 0.1;
  return test_scene::looking_at({2.1 * std::sin(angle), 1.25, 2.1 * std::cos(angle)}, {0, 1.1, 0});
}

// The figure in its room with `strength` times the predicted errors on top.
inline cv::Mat bent_image(const DepthOptics& optics, const Isometry3d& pose, double strength, double noise,
                          std::uint64_t seed) {
  const cv::Mat exact =
      test_scene::depth_image(test_scene::standing_figure(), optics.calibration, optics.rays, pose, noise, seed);
  const SurfaceCells cells = surface_cells(exact, {}, optics);
  return without_bounce(exact, cells, light_of(cells), {}, optics, -strength);
}

}  // namespace dressform::multipath_test
