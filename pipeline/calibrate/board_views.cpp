#include "pipeline/calibrate/board_views.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr int wide_image = 1200;                        // from here on an image is searched at half size first
constexpr int small_image = 800;                        // up to here it is enlarged
constexpr int widest_window = 8, narrowest_window = 2;  // half of the refining window's edge, pixels
constexpr double window_part = 0.45;  // of the corners' spacing: the window stays within the four squares
constexpr double darkest = 0.01, brightest = 0.998;  // quantiles that become black and white

// 8-bit grey, contrast stretched between two quantiles; the root evens out the light's fall with distance.
cv::Mat stretched(const cv::Mat& image) {
  cv::Mat grey = image, values;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(values, CV_32F);
  const std::vector<float> levels(values.begin<float>(), values.end<float>());
  const float low = lower_quantile(levels, darkest), high = std::max(lower_quantile(levels, brightest), low + 1);
  values = cv::min(cv::max((values - low) / (high - low), 0), 1);
  if (image.depth() == CV_16U) cv::sqrt(values, values);
  cv::Mat result;
  values.convertTo(result, CV_8U, 255);
  return result;
}

cv::Mat resampled(const cv::Mat& image, double factor) {
  if (factor == 1) return image;
  cv::Mat result;
  cv::resize(image, result, {}, factor, factor, factor > 1 ? cv::INTER_CUBIC : cv::INTER_AREA);
  return result;
}

// Least distance of neighbouring corners.
double least_spacing(const std::vector<cv::Point2f>& corners, const BoardGrid& grid) {
  double least = 1e9;
  for (int i = 0; i < grid.count(); ++i) {
    if (i % grid.columns) least = std::min(least, cv::norm(corners[i] - corners[i - 1]));
    if (i >= grid.columns) least = std::min(least, cv::norm(corners[i] - corners[i - grid.columns]));
  }
  return least;
}

void rescale(std::vector<cv::Point2f>& corners, double factor) {
  const cv::Point2f half(0.5f, 0.5f);
  for (auto& corner : corners) corner = (corner + half) * static_cast<float>(factor) - half;
}

// The detector's own positions are off by a few hundredths of a pixel in the same direction all over one board. Saddle
// points of a window that stays within the four squares scatter more and average out.
void refine(const cv::Mat& grey, const BoardGrid& grid, std::vector<cv::Point2f>& corners) {
  const double factor = grey.cols <= small_image ? 2 : 1;
  rescale(corners, factor);
  const int window =
      std::clamp(static_cast<int>(window_part * least_spacing(corners, grid)), narrowest_window, widest_window);
  const auto before = corners;
  cv::cornerSubPix(resampled(grey, factor), corners, {window, window}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-4});
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (2 * cv::norm(corners[i] - before[i]) > window) corners[i] = before[i];  // ran off to another corner
  rescale(corners, 1 / factor);
}

// How an image is searched: how much it is enlarged first, and whether at every scale.
struct Search {
  double factor;
  bool exhaustive;
};

// The quickest that may do first: a good board is found by it in a quarter of the time, and the corners are refined in
// the image itself whichever search found them. The exhaustive one takes seconds on large images that show no board.
std::vector<Search> searches(int width) {
  if (width >= wide_image) return {{0.5, false}, {0.5, true}, {1, true}};
  if (width <= small_image) return {{1, false}, {2, true}, {3, false}};
  return {{1, false}, {1, true}};
}

std::vector<cv::Point2f> found_by(const Search& search, const cv::Mat& grey, const BoardGrid& grid) {
  std::vector<cv::Point2f> corners;
  const int flags = cv::CALIB_CB_ACCURACY | (search.exhaustive ? cv::CALIB_CB_EXHAUSTIVE : 0);
  const bool found =
      cv::findChessboardCornersSB(resampled(grey, search.factor), {grid.columns, grid.rows}, corners, flags);
  if (!found || static_cast<int>(corners.size()) != grid.count()) return {};
  rescale(corners, 1 / search.factor);
  refine(grey, grid, corners);
  return corners;
}

std::vector<Vector2d> right_handed(const std::vector<cv::Point2f>& corners, const BoardGrid& grid) {
  const cv::Point2f along = corners[grid.columns - 1] - corners[0];
  const cv::Point2f down = corners[static_cast<std::size_t>(grid.columns) * (grid.rows - 1)] - corners[0];
  const bool mirrored = along.cross(down) < 0;
  std::vector<Vector2d> result;
  for (int i = 0; i < grid.count(); ++i) {
    const int x = i % grid.columns, y = i / grid.columns;
    const auto& corner = corners[y * grid.columns + (mirrored ? grid.columns - 1 - x : x)];
    result.emplace_back(corner.x, corner.y);
  }
  return result;
}

// Means of 3 x 3 pixels that all have depth, about the middles of the squares between inner corners.
std::vector<BoardDepth> depth_on_board(const cv::Mat& depth_mm, const std::vector<Vector2d>& ir,
                                       const BoardGrid& grid) {
  std::vector<BoardDepth> result;
  for (int y = 0; y + 1 < grid.rows; ++y)
    for (int x = 0; x + 1 < grid.columns; ++x) {
      const int i = y * grid.columns + x;
      const Vector2d middle = 0.25 * (ir[i] + ir[i + 1] + ir[i + grid.columns] + ir[i + grid.columns + 1]);
      const cv::Rect window(static_cast<int>(std::lround(middle.x())) - 1,
                            static_cast<int>(std::lround(middle.y())) - 1, 3, 3);
      if ((window & cv::Rect({}, depth_mm.size())) != window) continue;
      const cv::Mat patch = depth_mm(window);
      if (cv::countNonZero(patch) < 9) continue;
      result.push_back({Vector2d(window.x + 1, window.y + 1), 1e-3 * cv::mean(patch)[0]});
    }
  return result;
}

}  // namespace

std::vector<Vector2d> find_board(const cv::Mat& image, const BoardGrid& grid) {
  if (image.empty()) return {};
  const cv::Mat grey = stretched(image);
  for (const Search& search : searches(image.cols)) {
    const auto corners = found_by(search, grey, grid);
    if (!corners.empty()) return right_handed(corners, grid);
  }
  return {};
}

SensorBoards find_boards(const Boards& boards, const std::string& sensor) {
  const auto& shots = boards.shots.at(sensor);
  SensorBoards result;
  result.sensor = sensor;
  result.grid = {boards.inner_corners_x, boards.inner_corners_y, boards.square_m};
  result.shots = static_cast<int>(shots.size());
  result.ir_size = shots.front().ir.size();
  result.color_size = shots.front().color.size();
  std::vector<BoardView> views(shots.size());
  tbb::parallel_for(std::size_t(0), 2 * shots.size(), [&](std::size_t job) {
    BoardView& view = views[job / 2];
    const BoardShot& shot = shots[job / 2];
    if (job % 2) {
      view.color = find_board(shot.color, result.grid);
      return;
    }
    view.shot = static_cast<int>(job / 2);
    view.ir = find_board(shot.ir, result.grid);
    if (!view.ir.empty()) view.depth = depth_on_board(shot.depth_mm, view.ir, result.grid);
  });
  for (auto& view : views)
    if (!view.ir.empty() || !view.color.empty()) result.views.push_back(std::move(view));
  match_corner_order(result);
  return result;
}

}  // namespace dressform
