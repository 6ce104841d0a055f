#include <cmath>
#include <opencv2/calib3d.hpp>

#include "pipeline/calibrate/from_boards.h"

namespace dressform {
namespace {

using Points2 = std::vector<std::vector<cv::Point2f>>;
using Points3 = std::vector<std::vector<cv::Point3f>>;

std::vector<cv::Point2f> to_opencv(const std::vector<Vector2d>& corners) {
  std::vector<cv::Point2f> result;
  for (const auto& corner : corners)
    result.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  return result;
}

std::vector<cv::Point3f> board_points(const BoardGrid& grid) {
  std::vector<cv::Point3f> result;
  for (int i = 0; i < grid.count(); ++i) {
    const Vector3d point = grid.point(i);
    result.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()), 0.0f);
  }
  return result;
}

cv::Mat matrix_of(const Camera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

cv::Mat distortion_of(const Camera& camera) {
  cv::Mat result(1, 5, CV_64F);
  for (int i = 0; i < 5; ++i) result.at<double>(i) = camera.distortion[i];
  return result;
}

// Zhang, "A flexible new technique for camera calibration", PAMI 2000, as OpenCV implements it.
Camera one_camera(const SensorBoards& boards, const Camera& rough, std::vector<Vector2d> BoardView::*corners,
                  bool distortion, double& focal_sigma) {
  Points2 images;
  for (const auto& view : boards.views)
    if (!(view.*corners).empty()) images.push_back(to_opencv(view.*corners));
  const Points3 objects(images.size(), board_points(boards.grid));
  int flags = cv::CALIB_USE_INTRINSIC_GUESS;
  if (!distortion) flags |= cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST;
  cv::Mat matrix = matrix_of(rough), coefficients = cv::Mat::zeros(1, 5, CV_64F), sigmas;
  std::vector<cv::Mat> turns, shifts;
  cv::calibrateCamera(objects, images, {rough.width, rough.height}, matrix, coefficients, turns, shifts, sigmas,
                      cv::noArray(), cv::noArray(), flags,
                      {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-12});
  Camera camera = rough;
  camera.fx = matrix.at<double>(0, 0), camera.fy = matrix.at<double>(1, 1);
  camera.cx = matrix.at<double>(0, 2), camera.cy = matrix.at<double>(1, 2);
  for (int i = 0; i < 5; ++i) camera.distortion[i] = coefficients.at<double>(i);
  focal_sigma = sigmas.at<double>(0) / camera.fx;
  return camera;
}

Isometry3d step_between(const SensorBoards& boards, const Camera& ir, const Camera& color) {
  Points2 in_ir, in_color;
  for (const auto& view : boards.views) {
    if (view.ir.empty() || view.color.empty()) continue;
    in_ir.push_back(to_opencv(view.ir));
    in_color.push_back(to_opencv(view.color));
  }
  const Points3 objects(in_ir.size(), board_points(boards.grid));
  cv::Mat ir_matrix = matrix_of(ir), ir_distortion = distortion_of(ir);
  cv::Mat color_matrix = matrix_of(color), color_distortion = distortion_of(color);
  cv::Mat rotation, translation;
  cv::stereoCalibrate(objects, in_ir, in_color, ir_matrix, ir_distortion, color_matrix, color_distortion,
                      {ir.width, ir.height}, rotation, translation, cv::noArray(), cv::noArray(),
                      cv::CALIB_FIX_INTRINSIC, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-10});
  Isometry3d step = Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) step.linear()(r, c) = rotation.at<double>(r, c);
    step.translation()[r] = translation.at<double>(r);
  }
  return step;
}

}  // namespace

BoardSolution opencv_calibration(const SensorBoards& boards, bool distortion) {
  BoardSolution solution;
  SensorCalibration& sensor = solution.sensor;
  sensor.ir = one_camera(boards, rough_ir_camera(boards), &BoardView::ir, distortion, solution.ir_focal_sigma);
  if (boards.color_size.area() > 0) {
    sensor.color =
        one_camera(boards, rough_color_camera(boards), &BoardView::color, distortion, solution.color_focal_sigma);
    sensor.color_from_ir = step_between(boards, sensor.ir, *sensor.color);
  }
  solution.ir_from_board = start_poses(boards, sensor);
  solution.converged = std::isfinite(solution.ir_focal_sigma) && std::isfinite(solution.color_focal_sigma);
  return solution;
}

}  // namespace dressform
