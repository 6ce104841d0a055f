#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "scenes/capture_session.h"

namespace dressform {

// Inner corners of a board: index y * columns + x stands at (x, y, 0) * square_m.
struct BoardGrid {
  int columns = 0, rows = 0;
  double square_m = 0;

  int count() const { return columns * rows; }
  Vector3d point(int index) const { return {square_m * (index % columns), square_m * (index / columns), 0}; }
};

// Depth measured on the board: the mean over 3 x 3 pixels about the middle of one square, as measured.
struct BoardDepth {
  Vector2d pixel;  // of the IR grid
  double depth_m = 0;
};

// One shot of the board. Corners in the order of BoardGrid, the same order in both images; empty: not found.
struct BoardView {
  int shot = 0;
  std::vector<Vector2d> ir, color;
  std::vector<BoardDepth> depth;
};

// Whether depth was measured on enough squares to say where the board is.
inline bool enough_depth(const BoardView& view) { return view.depth.size() >= 8; }

struct SensorBoards {
  std::string sensor;
  BoardGrid grid;
  cv::Size ir_size, color_size;
  std::vector<BoardView> views;  // those where the board was found in some image
  int shots = 0, turned = 0;
};

// Corners of the board in a raw image of any depth with one or three channels: detected on a contrast-stretched copy
// (Duda and Frese, "Accurate detection and localization of checkerboard corners for calibration", BMVC 2018, by
// OpenCV), enlarged or shrunk to where the squares suit the detector; refined at full size where it was shrunk.
// Right-handed: column to row turns like x to y of the image. Empty where the board is not found, or not whole.
std::vector<Vector2d> find_board(const cv::Mat& image, const BoardGrid& grid);

// Finds the board in all shots of a sensor; shots side by side, the result does not depend on that. The order of the
// corners in colour is matched to infrared's, see board_order.cpp. Throws InputError naming the sensor where the two
// images are mirrored against each other or do not show the same boards.
SensorBoards find_boards(const Boards& boards, const std::string& sensor);

// Puts the colour corners of every view into the order of the infrared ones.
void match_corner_order(SensorBoards& boards);

// Largest scale of the board in the image, pixels per metre: along the direction that its tilt does not shorten.
double board_scale(const std::vector<Vector2d>& corners, const BoardGrid& grid);

// Cameras good enough to start from: no distortion, principal point in the middle, focal length from the board's scale
// and the depth measured on it; without depth by the vanishing points (Zhang 2000).
Camera rough_ir_camera(const SensorBoards& boards);
Camera rough_color_camera(const SensorBoards& boards);

// Camera from board for a camera's corners. Throws nothing; planar pose with the board in front.
Isometry3d board_pose(const Camera& camera, const std::vector<Vector2d>& corners, const BoardGrid& grid);

}  // namespace dressform
