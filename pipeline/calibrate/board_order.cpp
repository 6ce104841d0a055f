#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "pipeline/calibrate/board_views.h"
#include "scenes/error.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double same_turn_deg = 15;      // between what two boards say of the turn from camera to camera
constexpr double least_spread = 0.04;     // deviation of the boards' directions (x/z), to tell mirrored images
constexpr double least_opposition = 0.8;  // correlation of the directions in the two images, with the sign turned
constexpr double usual_focal = 0.7;       // of the image's width: 71 degrees wide
constexpr double shortest_focal = 0.35, longest_focal = 3;  // the same: what no Kinect is beyond

double angle_deg(const Eigen::Matrix3d& rotation) { return Eigen::AngleAxisd(rotation).angle() * 180 / M_PI; }

// The corners as they read when the board is turned in its plane by `quarter` right angles (1 and 3: square boards).
std::vector<Vector2d> turned(const std::vector<Vector2d>& corners, const BoardGrid& grid, int quarter) {
  std::vector<Vector2d> result(corners.size());
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      int u = x, v = y;
      for (int i = 0; i < quarter % 2; ++i) u = grid.rows - 1 - y, v = x;
      if (quarter >= 2) u = grid.columns - 1 - u, v = grid.rows - 1 - v;
      result[y * grid.columns + x] = corners[v * grid.columns + u];
    }
  return result;
}

struct Pair {
  BoardView* view;
  std::vector<int> quarters;
  std::vector<Eigen::Matrix3d> color_from_ir;  // by the turn of the colour corners
};

std::vector<Pair> pairs_of(SensorBoards& boards, const Camera& ir, const Camera& color) {
  std::vector<Pair> pairs;
  for (auto& view : boards.views) {
    if (view.ir.empty() || view.color.empty()) continue;
    Pair pair{&view, {0, 2}, {}};
    if (boards.grid.columns == boards.grid.rows) pair.quarters = {0, 1, 2, 3};
    const Eigen::Matrix3d ir_from_board = board_pose(ir, view.ir, boards.grid).linear();
    for (const int quarter : pair.quarters)
      pair.color_from_ir.push_back(board_pose(color, turned(view.color, boards.grid, quarter), boards.grid).linear() *
                                   ir_from_board.transpose());
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

int best_turn(const Pair& pair, const Eigen::Matrix3d& color_from_ir) {
  int best = 0;
  double least = 1e9;
  for (std::size_t k = 0; k < pair.color_from_ir.size(); ++k) {
    const double angle = angle_deg(pair.color_from_ir[k] * color_from_ir.transpose());
    if (angle < least) least = angle, best = static_cast<int>(k);
  }
  return best;
}

// The rotation between the cameras that most pairs agree on, whichever way their boards read; of several the least.
Eigen::Matrix3d common_rotation(const std::vector<Pair>& pairs, int& agreeing) {
  Eigen::Matrix3d best = Eigen::Matrix3d::Identity();
  agreeing = 0;
  for (const auto& candidate : pairs)
    for (const auto& rotation : candidate.color_from_ir) {
      int count = 0;
      for (const auto& pair : pairs)
        count += angle_deg(pair.color_from_ir[best_turn(pair, rotation)] * rotation.transpose()) < same_turn_deg;
      if (count > agreeing || (count == agreeing && angle_deg(rotation) < angle_deg(best)))
        best = rotation, agreeing = count;
    }
  return best;
}

// Directions to the boards' middles grow together in both cameras, unless one image is mirrored.
void check_not_mirrored(const SensorBoards& boards, const std::vector<Pair>& pairs, const Camera& ir,
                        const Camera& color) {
  const auto middle_of = [](const std::vector<Vector2d>& corners) {
    Vector2d sum = Vector2d::Zero();
    for (const auto& corner : corners) sum += corner;
    return Vector2d(sum / corners.size());
  };
  for (int axis = 0; axis < 2; ++axis) {
    double sa = 0, sb = 0, saa = 0, sab = 0, sbb = 0;
    const auto n = static_cast<double>(pairs.size());
    for (const auto& pair : pairs) {
      const double a = ir.normalized(middle_of(pair.view->ir))[axis];
      const double b = color.normalized(middle_of(pair.view->color))[axis];
      sa += a, sb += b, saa += a * a, sab += a * b, sbb += b * b;
    }
    const double vaa = saa / n - sa * sa / n / n, vab = sab / n - sa * sb / n / n, vbb = sbb / n - sb * sb / n / n;
    const bool wide = vaa > least_spread * least_spread && vbb > least_spread * least_spread;
    if (pairs.size() >= 3 && wide && vab < -least_opposition * std::sqrt(vaa * vbb))
      throw InputError("boards/" + boards.sensor, std::string("colour and infrared are mirrored against each other ") +
                                                      (axis == 0 ? "(left and right)" : "(top and bottom)") +
                                                      "; expected both as the cameras see the scene, or both mirrored");
  }
}

}  // namespace

// A board of even x even squares looks the same when it is turned by 180 degrees, so that its corners may be listed
// from either end: each pair of images is taken the way that agrees with the rotation most pairs share.
void match_corner_order(SensorBoards& boards) {
  const auto paired = [](const BoardView& view) { return !view.ir.empty() && !view.color.empty(); };
  if (std::none_of(boards.views.begin(), boards.views.end(), paired)) return;
  const Camera ir = rough_ir_camera(boards), color = rough_color_camera(boards);
  auto pairs = pairs_of(boards, ir, color);
  check_not_mirrored(boards, pairs, ir, color);
  int agreeing = 0;
  const Eigen::Matrix3d rotation = common_rotation(pairs, agreeing);
  if (2 * agreeing < static_cast<int>(pairs.size()))
    throw InputError("boards/" + boards.sensor, "the boards in colour and infrared agree in " +
                                                    std::to_string(agreeing) + " of " + std::to_string(pairs.size()) +
                                                    " shots; expected images that were taken together");
  for (auto& pair : pairs) {
    const int best = best_turn(pair, rotation);
    if (pair.quarters[best] == 0) continue;
    pair.view->color = turned(pair.view->color, boards.grid, pair.quarters[best]);
    ++boards.turned;
  }
}

double board_scale(const std::vector<Vector2d>& corners, const BoardGrid& grid) {
  // Least squares of an affine map from the board to the image.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (int i = 0; i < grid.count(); ++i) {
    const Vector3d point(grid.point(i).x(), grid.point(i).y(), 1);
    normal += point * point.transpose();
    right += point * corners[i].transpose();
  }
  const Eigen::Matrix2d map = (normal.ldlt().solve(right)).topRows<2>();
  return Eigen::JacobiSVD<Eigen::Matrix2d>(map).singularValues()[0];
}

namespace {

Camera plain_camera(cv::Size size, double focal) {
  return {size.width, size.height, focal, focal, 0.5 * (size.width - 1), 0.5 * (size.height - 1), {0, 0, 0, 0, 0}};
}

double focal_by_vanishing_points(const std::vector<const std::vector<Vector2d>*>& views, const BoardGrid& grid,
                                 cv::Size size) {
  const double usual = usual_focal * size.width;
  if (views.empty()) return usual;
  std::vector<std::vector<cv::Point3f>> objects;
  std::vector<std::vector<cv::Point2f>> images;
  for (const auto* corners : views) {
    objects.emplace_back();
    images.emplace_back();
    for (int i = 0; i < grid.count(); ++i) {
      const Vector3d point = grid.point(i);
      objects.back().emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()), 0.0f);
      images.back().emplace_back(static_cast<float>((*corners)[i].x()), static_cast<float>((*corners)[i].y()));
    }
  }
  const double focal = cv::initCameraMatrix2D(objects, images, size).at<double>(0, 0);
  return focal > shortest_focal * size.width && focal < longest_focal * size.width ? focal : usual;
}

Camera rough_camera(const SensorBoards& boards, bool color) {
  const cv::Size size = color ? boards.color_size : boards.ir_size;
  std::vector<double> focals;
  std::vector<const std::vector<Vector2d>*> views;
  for (const auto& view : boards.views) {
    const auto& corners = color ? view.color : view.ir;
    if (corners.empty()) continue;
    views.push_back(&corners);
    if (!enough_depth(view)) continue;
    std::vector<double> depths;
    for (const auto& sample : view.depth) depths.push_back(sample.depth_m);
    focals.push_back(board_scale(corners, boards.grid) * median(std::move(depths)));
  }
  if (!focals.empty()) return plain_camera(size, median(std::move(focals)));
  return plain_camera(size, focal_by_vanishing_points(views, boards.grid, size));
}

}  // namespace

Camera rough_ir_camera(const SensorBoards& boards) { return rough_camera(boards, false); }
Camera rough_color_camera(const SensorBoards& boards) { return rough_camera(boards, true); }

Isometry3d board_pose(const Camera& camera, const std::vector<Vector2d>& corners, const BoardGrid& grid) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (int i = 0; i < grid.count(); ++i) {
    const Vector3d point = grid.point(i);
    const Vector2d ideal = camera.normalized(corners[i]);
    object.emplace_back(point.x(), point.y(), 0);
    image.emplace_back(ideal.x(), ideal.y());
  }
  cv::Vec3d turn, shift;
  cv::solvePnP(object, image, cv::Matx33d::eye(), cv::noArray(), turn, shift, false, cv::SOLVEPNP_ITERATIVE);
  Isometry3d pose = Isometry3d::Identity();
  const Vector3d axis(turn[0], turn[1], turn[2]);
  if (axis.norm() > 0) pose.linear() = Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix();
  pose.translation() = Vector3d(shift[0], shift[1], shift[2]);
  return pose;
}

}  // namespace dressform
