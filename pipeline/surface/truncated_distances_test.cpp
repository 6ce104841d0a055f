#include "pipeline/surface/truncated_distances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/imaging/color_mapping.h"

namespace dressform {
namespace {

constexpr double kRadius_m = 0.15;

SensorCalibration distorted_sensor() {
  SensorCalibration sensor;
  sensor.ir.width = 128;
  sensor.ir.height = 106;
  sensor.ir.fx = sensor.ir.fy = 92;
  sensor.ir.cx = 63.5;
  sensor.ir.cy = 52.5;
  sensor.ir.distortion = {0.09, -0.27, 0, 0, 0.09};
  return sensor;
}

// A ball at the origin seen from 1 m away, at `turn` round the vertical, before a wall 1 m behind it.
DepthView view_of_ball(const SensorCalibration& sensor, double turn, cv::Mat& ball_mm) {
  DepthView view;
  view.sensor = &sensor;
  view.model_from_sensor.linear() =
      (Eigen::AngleAxisd(turn, Vector3d::UnitY()) * Eigen::AngleAxisd(M_PI, Vector3d::UnitX())).toRotationMatrix();
  view.model_from_sensor.translation() = view.model_from_sensor.linear() * Vector3d(0, 0, -1);
  view.sensor_from_model = view.model_from_sensor.inverse();
  view.rays = pixel_rays(sensor.ir);
  view.depth_mm = cv::Mat(sensor.ir.height, sensor.ir.width, CV_32F, cv::Scalar(2000));
  ball_mm = cv::Mat(view.depth_mm.size(), CV_32F, cv::Scalar(0));
  for (int y = 0; y < ball_mm.rows; ++y)
    for (int x = 0; x < ball_mm.cols; ++x) {
      const Vector3d ray = sensor.ir.unproject({static_cast<double>(x), static_cast<double>(y)}, 1).normalized();
      const double half = ray.z(), inside = half * half - 1 + kRadius_m * kRadius_m;
      if (inside < 0) continue;
      view.depth_mm.at<float>(y, x) = ball_mm.at<float>(y, x) =
          static_cast<float>(1000 * (half - std::sqrt(inside)) * ray.z());
    }
  return view;
}

TEST(TruncatedDistances, ABallFromFourSides) {
  const SensorCalibration sensor = distorted_sensor();
  std::vector<DepthView> views(4);
  std::vector<ClothDepth> cloth;
  for (int k = 0; k < 4; ++k) {
    cv::Mat ball_mm;
    views[k] = view_of_ball(sensor, k * M_PI / 2, ball_mm);
    cloth.push_back(cloth_depth(views[k], ball_mm, {}));
  }
  const Lattice lattice = make_lattice(Vector3d::Constant(-kRadius_m), Vector3d::Constant(kRadius_m), 0.05, 0.012);
  const std::vector<float> field = truncated_distances(lattice, cloth, {});
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Vector3d p = lattice.point(i);
    const double truth = p.norm() - kRadius_m;
    if (truth < -0.03) {
      EXPECT_LT(field[i], 0) << p.transpose();
    }
    // Above and below, the views look past the ball's poles at a low angle.
    if (truth > 0.03 && std::abs(p.y()) < 0.1) {
      EXPECT_GT(field[i], 0) << p.transpose();
    }
    if (std::abs(p.y()) < 0.06 && std::abs(truth) < 0.01) {
      EXPECT_NEAR(field[i], truth, 0.008) << p.transpose();
    }
  }
}

TEST(TruncatedDistances, WithoutViewsNothingIsInside) {
  const Lattice lattice = make_lattice(Vector3d::Zero(), Vector3d::Constant(0.1), 0.01, 0.02);
  for (const float value : truncated_distances(lattice, {}, {})) EXPECT_GT(value, 0);
}

}  // namespace
}  // namespace dressform
