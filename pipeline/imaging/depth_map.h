#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

using Eigen::Vector2f;
using Eigen::Vector3f;

// Fast projection with lens distortion in single precision, for inner loops. Agrees with Camera::project to about
// 1e-3 pixel inside the image; points behind the camera or far outside the image are refused.
class Projector {
 public:
  explicit Projector(const Camera& camera);
  // Pixel of a point (metres, camera frame); false when it falls outside the image.
  bool operator()(const Vector3f& point, Vector2f& pixel) const {
    if (point.z() < 0.05f) return false;
    const float inverse = 1.0f / point.z(), x = point.x() * inverse, y = point.y() * inverse, s = x * x + y * y;
    if (s > largest_radius_squared_) return false;
    const float radial = 1 + s * (k1_ + s * (k2_ + s * k3_));
    pixel.x() = fx_ * (x * radial + 2 * p1_ * x * y + p2_ * (s + 2 * x * x)) + cx_;
    pixel.y() = fy_ * (y * radial + p1_ * (s + 2 * y * y) + 2 * p2_ * x * y) + cy_;
    return pixel.x() > -0.5f && pixel.y() > -0.5f && pixel.x() < width_ - 0.5f && pixel.y() < height_ - 0.5f;
  }

 private:
  float fx_, fy_, cx_, cy_, k1_, k2_, p1_, p2_, k3_, width_, height_, largest_radius_squared_;
};

struct DepthMapOptions {
  double min_depth_m = 0.4, max_depth_m = 4.5;
  // A step between neighbouring pixels larger than that of a surface this oblique, plus noise, is an edge. Pixels
  // beside an edge, and pixels beside three or more empty ones, are dropped: the sensor mixes there.
  double edge_angle_deg = 80;
  int shrink = 1;           // pixels of the map average shrink x shrink pixels of the image
  double min_cosine = 0.3;  // between normal and line of sight, below which a point has no normal
  double noise_factor = 1;  // of the sensor over the usual curve (depth_noise_factor)
};

// A depth image as points. Grids are row-major, width * height of `camera`.
struct DepthMap {
  Camera camera;                  // of this grid
  std::vector<Vector3f> points;   // metres, sensor frame; z = 0 where there is none
  std::vector<Vector3f> normals;  // unit, towards the sensor; zero where there is none
  std::vector<float> sigma_m;     // expected noise of the point along its normal; 0 where there is no normal
  int valid = 0;                  // points with a normal

  bool has_normal(int index) const { return sigma_m[index] > 0; }
};

// The depths of all points in the middle of the image, metres: where the thing is that the sensor was pointed at.
std::vector<float> middle_depths_m(const DepthMap& map);

// Depth in metres (CV_32F, 0 = none) with the sensor's offset taken off, without flying pixels and edge pixels.
cv::Mat clean_depth(const cv::Mat& depth_mm, const SensorCalibration& calibration, const DepthMapOptions& options);

// Points with normals from a cleaned depth image. `rays` is normalized_grid of the shrunken camera (see
// `shrunken_camera`), computed once per sensor. Normals are fits of a plane to 5 x 5 pixels: a plane is linear in
// inverse depth.
DepthMap make_depth_map(const cv::Mat& depth_m, const Camera& camera, const cv::Mat& rays,
                        const DepthMapOptions& options);
Camera shrunken_camera(const Camera& camera, int shrink);

// The whole of it for a single image.
DepthMap make_depth_map(const cv::Mat& depth_mm, const SensorCalibration& calibration, const DepthMapOptions& options);

}  // namespace dressform
