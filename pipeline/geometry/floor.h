#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "scenes/registry.h"

namespace dressform {

struct FloorSearch {
  Eigen::Vector3d up = Eigen::Vector3d(0, -1, 0);  // rough, sensor frame, unit
  double tilt_deg = 20;                            // largest angle between the floor's normal and `up`
  double tolerance_m = 0.02;                       // of an inlier
  int least_inliers = 200;
  int draws = 300;
};

// The floor: the lowest plane that many points lie on and hardly any lies below. RANSAC over triples of points
// (metres), then least squares on the inliers. (n, d): n.p + d = 0 with unit n pointing up.
// Empty when no plane qualifies. Fischler and Bolles, CACM 1981.
std::optional<Eigen::Vector4d> find_floor(const std::vector<Eigen::Vector3d>& points_m, const FloorSearch& search,
                                          Seed seed, std::uint64_t stream);

// The same for the points of one depth image (float32 x 3, metres, NaN = none): a quarter of its lower pixels is
// looked at, and so a quarter of `least_inliers` is asked for.
std::optional<Eigen::Vector4d> find_floor(const cv::Mat& points_m, const FloorSearch& search, Seed seed,
                                          std::uint64_t stream);

// Least-squares plane (n, d) of points; the sign of n is arbitrary. Needs three points that are not on a line.
Eigen::Vector4d fit_plane(const std::vector<Eigen::Vector3d>& points);

}  // namespace dressform
