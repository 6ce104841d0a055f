#include <algorithm>
#include <cmath>

#include "scenes/error.h"
#include "scenes/random.h"
#include "synthetic/boards/board.h"

namespace dressform {
namespace {

constexpr double degree = M_PI / 180;
constexpr int tries = 400;
constexpr double margin_px = 3;

// A point of the R2 sequence (Roberts): covers the square evenly however many are taken.
Vector2d even(int index, const Vector2d& start) {
  const Vector2d step(0.7548776662466927, 0.5698402909980532);
  const Vector2d at = start + index * step;
  return {at.x() - std::floor(at.x()), at.y() - std::floor(at.y())};
}

bool within(const Camera& camera, const Vector3d& point) {
  if (point.z() < 0.1) return false;
  const Vector2d pixel = camera.project(point);
  return pixel.x() > margin_px && pixel.y() > margin_px && pixel.x() < camera.width - 1 - margin_px &&
         pixel.y() < camera.height - 1 - margin_px;
}

// Outline of the pattern, where it might leave an image; lens distortion bends long edges.
std::vector<Vector3d> outline(const BoardsSpec& spec) {
  const double x = 0.5 * spec.square_m * spec.squares_x, y = 0.5 * spec.square_m * spec.squares_y;
  std::vector<Vector3d> points;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      if (std::abs(i) == 2 || std::abs(j) == 2) points.emplace_back(0.5 * i * x, 0.5 * j * y, 0);
  return points;
}

bool visible(const SensorCalibration& sensor, const Isometry3d& ir_from_board, const std::vector<Vector3d>& points) {
  return std::all_of(points.begin(), points.end(), [&](const Vector3d& point) {
    const Vector3d in_ir = ir_from_board * point;
    return within(sensor.ir, in_ir) && (!sensor.color || within(*sensor.color, sensor.color_from_ir * in_ir));
  });
}

// Numbers in 0-1 that make one pose.
struct Draw {
  Vector2d place, turn;  // in the image; tilt axis and roll
  double distance, tilt;
};

Isometry3d pose_of(const BoardsSpec& spec, const Camera& camera, const Draw& draw, int view) {
  const Vector2d pixel(draw.place.x() * (camera.width - 1), draw.place.y() * (camera.height - 1));
  const double distance_m = spec.nearest_m + draw.distance * (spec.farthest_m - spec.nearest_m);
  const double part = view % 5 == 0 ? 0.1 * draw.tilt : 0.35 + 0.65 * draw.tilt;
  const double axis = 2 * M_PI * draw.turn.x();
  const double roll_deg = (view % 2 ? 90 : 0) + 50 * (draw.turn.y() - 0.5);
  Isometry3d ir_from_board = Isometry3d::Identity();
  ir_from_board.linear() =
      (Eigen::AngleAxisd(part * spec.tilt_deg * degree, Vector3d(std::cos(axis), std::sin(axis), 0)) *
       Eigen::AngleAxisd(roll_deg * degree, Vector3d::UnitZ()))
          .toRotationMatrix();
  ir_from_board.translation() = camera.unproject(pixel, distance_m);
  return ir_from_board;
}

}  // namespace

std::vector<Isometry3d> board_poses(const BoardsSpec& spec, const SensorSpec& sensor, Seed seed) {
  const std::uint64_t stream = stream_of(("boards " + sensor.name).c_str());
  const auto start = uniform4(seed, stream, 0);
  const auto points = outline(spec);
  std::vector<Isometry3d> poses;
  for (int view = 0, index = 0; view < spec.views; ++view) {
    bool found = false;
    for (int i = 0; i < tries && !found; ++i, ++index) {
      const auto random = uniform4(seed, stream, 1 + index);
      const double shrink = 1 - 0.9 * i / tries;  // towards the middle where little room is left
      Draw draw;
      draw.place = Vector2d::Constant(0.5) + shrink * (even(index, {start[0], start[1]}) - Vector2d::Constant(0.5));
      draw.turn = even(view, {start[2], start[3]});
      draw.distance = even(view, {random[0] / spec.views, 0}).x();
      if (i > tries / 2) draw.distance = 1 - (1 - draw.distance) * shrink;
      draw.tilt = random[1];
      poses.push_back(pose_of(spec, sensor.calibration.ir, draw, view));
      found = visible(sensor.calibration, poses.back(), points);
      if (!found) poses.pop_back();
    }
    if (!found)
      throw InputError("boards", "the board does not fit into the images of " + sensor.name +
                                     "; expected a smaller board or a larger farthest_m");
  }
  return poses;
}

}  // namespace dressform
