#pragma once
// For the tests of fuse: a scan that all of them share, and how far what was made of one is off.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/testing/test_scene.h"
#include "scenes/fields.h"
#include "scenes/statistics.h"

namespace dressform::fuse_test {

constexpr double kDegrees = 180 / M_PI;

// Largest error of a pose relative to the middle frame: at the figure's centre, and of the rotation.
struct PoseErrors {
  double largest_m = 0, largest_deg = 0;
};
inline PoseErrors pose_errors(const std::vector<Isometry3d>& found, const std::vector<Isometry3d>& truth) {
  const std::size_t middle = truth.size() / 2;
  const Isometry3d world = truth[middle] * found[middle].inverse();
  PoseErrors errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!found[i].matrix().allFinite()) continue;
    const Isometry3d error = truth[i] * (world * found[i]).inverse();
    const Vector3d centre(0, 1, 0);
    errors.largest_m = std::max(errors.largest_m, (error * centre - centre).norm());
    errors.largest_deg = std::max(errors.largest_deg, kDegrees * Eigen::AngleAxisd(error.linear()).angle());
  }
  return errors;
}

inline double median_error_m(const Mesh& body, const Isometry3d& world_from_model, const test_scene::Figure& figure) {
  std::vector<double> errors;
  for (const auto& p : body.vertices) errors.push_back(std::abs(test_scene::distance_to(figure, world_from_model * p)));
  return median(std::move(errors));
}

// A walk round the figure with a sensor's noise, once and a bit.
inline const test_scene::Scan& noisy_scan() {
  static const test_scene::Scan scan =
      test_scene::walk_round(test_scene::standing_figure(), test_scene::kinect(0.25, -0.015), 120, 390, 1, 7);
  return scan;
}

// Where a test is not about the body's shape: the closed surface, which takes most of the time, from coarser parts.
inline const FieldValues kCoarseBody{{"voxel_m", 0.008}, {"truncation_m", 0.03}, {"poisson_depth", 6}};

}  // namespace dressform::fuse_test
