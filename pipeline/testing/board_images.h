#pragma once
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/calibrate/board_views.h"
#include "scenes/random.h"

namespace dressform::board_images {

// A printed board on a dark plain ground, seen without noise but for one grey level.

inline BoardGrid grid() { return {7, 5, 0.05}; }  // 8 x 6 squares: looks the same turned by 180 degrees

inline SensorCalibration sensor() {
  SensorCalibration s;
  s.model = "kinect_v2";
  s.ir = Camera{512, 424, 371.2, 369.97, 246.1, 199.2, {0.0966, -0.2830, 0.00016, -0.00051, 0.1052}};
  s.color = Camera{960, 540, 536.7, 534.3, 470.0, 265.4, {0.0563, -0.0742, 0.00143, -0.0017, 0.0241}};
  s.color_from_ir.linear() = (Eigen::AngleAxisd(0.004, Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  s.color_from_ir.translation() = Vector3d(0.0512, 0.0003, -0.0023);
  s.depth_offset_m = -0.014;
  return s;
}

// Brightness of the board's plane, 0 to 1: squares from one before the first inner corner, a white margin of one.
inline float brightness(double x_m, double y_m, const BoardGrid& grid) {
  const double u = x_m / grid.square_m + 1, v = y_m / grid.square_m + 1;
  const double columns = grid.columns + 1, rows = grid.rows + 1;
  if (u < -1 || v < -1 || u > columns + 1 || v > rows + 1) return 0.2f;
  if (u < 0 || v < 0 || u >= columns || v >= rows) return 0.9f;
  return (static_cast<int>(u) + static_cast<int>(v)) % 2 ? 0.9f : 0.1f;
}

struct Image {
  cv::Mat bright;   // CV_32F, 0 to 1
  cv::Mat depth_m;  // CV_32F, of the plane; 0 off the board
};

inline Image image(const Camera& camera, const Isometry3d& camera_from_board, const BoardGrid& grid) {
  const cv::Mat rays = normalized_grid(camera);
  const Vector3d normal = camera_from_board.linear().col(2);
  const double distance = normal.dot(camera_from_board.translation());
  const Isometry3d board_from_camera = camera_from_board.inverse();
  Image result{cv::Mat(rays.size(), CV_32F), cv::Mat::zeros(rays.size(), CV_32F)};
  constexpr int kSamples = 4;
  for (int y = 0; y < rays.rows; ++y)
    for (int x = 0; x < rays.cols; ++x) {
      const cv::Vec2d ray = rays.at<cv::Vec2d>(y, x);
      const cv::Vec2d right =
          x + 1 < rays.cols ? rays.at<cv::Vec2d>(y, x + 1) - ray : ray - rays.at<cv::Vec2d>(y, x - 1);
      const cv::Vec2d down =
          y + 1 < rays.rows ? rays.at<cv::Vec2d>(y + 1, x) - ray : ray - rays.at<cv::Vec2d>(y - 1, x);
      float sum = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const double dx = (k % kSamples + 0.5) / kSamples - 0.5, dy = (k / kSamples + 0.5) / kSamples - 0.5;
        const cv::Vec2d at = ray + right * dx + down * dy;
        const Vector3d direction(at[0], at[1], 1);
        const Vector3d on_board = board_from_camera * (direction * (distance / normal.dot(direction)));
        sum += brightness(on_board.x(), on_board.y(), grid);
      }
      result.bright.at<float>(y, x) = sum / (kSamples * kSamples);
      const Vector3d direction(ray[0], ray[1], 1);
      const Vector3d on_plane = direction * (distance / normal.dot(direction));
      const Vector3d on_board = board_from_camera * on_plane;
      const double u = on_board.x() / grid.square_m, v = on_board.y() / grid.square_m;
      if (u > -2 && v > -2 && u < grid.columns + 1 && v < grid.rows + 1)
        result.depth_m.at<float>(y, x) = static_cast<float>(on_plane.z());
    }
  cv::GaussianBlur(result.bright.clone(), result.bright, {}, 0.7);  // the lens
  return result;
}

inline BoardShot shot(const SensorCalibration& sensor, const Isometry3d& ir_from_board, const BoardGrid& grid) {
  const Image ir = image(sensor.ir, ir_from_board, grid);
  BoardShot shot;
  ir.bright.convertTo(shot.ir, CV_16U, 20000);
  cv::Mat(ir.depth_m + sensor.depth_offset_m).convertTo(shot.depth_mm, CV_16U, 1000);
  shot.depth_mm.setTo(0, ir.depth_m == 0);
  cv::Mat grey;
  image(*sensor.color, sensor.color_from_ir * ir_from_board, grid).bright.convertTo(grey, CV_8U, 255);
  cv::cvtColor(grey, shot.color, cv::COLOR_GRAY2BGR);
  return shot;
}

// A pose by its middle's place in the infrared image, its distance, tilt and turn in the plane.
inline Isometry3d pose(const SensorCalibration& sensor, const BoardGrid& grid, double x, double y, double distance_m,
                       double tilt_deg, double about_deg, double turn_deg) {
  const double degree = M_PI / 180, about = about_deg * degree;
  Isometry3d result = Isometry3d::Identity();
  result.linear() = (Eigen::AngleAxisd(tilt_deg * degree, Vector3d(std::cos(about), std::sin(about), 0)) *
                     Eigen::AngleAxisd(turn_deg * degree, Vector3d::UnitZ()))
                        .toRotationMatrix();
  result.translation() = sensor.ir.unproject({x, y}, distance_m);
  result.translate(Vector3d(-0.5 * grid.point(grid.count() - 1)));
  return result;
}

// Ten boards all over the image, tilted by up to 40 degrees.
inline std::vector<Isometry3d> varied_poses(const SensorCalibration& s) {
  const BoardGrid g = grid();
  return {pose(s, g, 256, 212, 0.8, 5, 0, 10),    pose(s, g, 150, 150, 1.1, 35, 20, -15),
          pose(s, g, 370, 150, 1.2, 38, 100, 80), pose(s, g, 140, 270, 1.0, 30, 170, 100),
          pose(s, g, 370, 270, 0.9, 36, 250, 20), pose(s, g, 256, 130, 1.4, 40, 310, 75),
          pose(s, g, 256, 290, 1.3, 33, 60, -25), pose(s, g, 110, 212, 1.5, 28, 130, 95),
          pose(s, g, 400, 212, 1.1, 34, 200, -5), pose(s, g, 300, 230, 0.75, 25, 280, 110)};
}

// A copy that shares no images.
inline Boards copy_of(const Boards& boards) {
  Boards copy = boards;
  for (auto& [sensor, shots] : copy.shots)
    for (auto& shot : shots) shot = {shot.color.clone(), shot.ir.clone(), shot.depth_mm.clone()};
  return copy;
}

inline Boards boards(const SensorCalibration& sensor, const std::vector<Isometry3d>& poses) {
  Boards result{grid().columns, grid().rows, grid().square_m, {}};
  for (const auto& each : poses) result.shots["k1"].push_back(shot(sensor, each, grid()));
  return result;
}

}  // namespace dressform::board_images
