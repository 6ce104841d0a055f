#include "pipeline/fill/garment_depth.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

// 255 where a pixel is beside a step of depth, or beside three or more pixels without depth: the sensor mixes there.
cv::Mat depth_edges(const cv::Mat& depth_mm, double jump_mm) {
  cv::Mat edges = cv::Mat::zeros(depth_mm.size(), CV_8U);
  const cv::Rect grid({0, 0}, depth_mm.size());
  for (int y = 0; y < edges.rows; ++y) {
    for (int x = 0; x < edges.cols; ++x) {
      const float center = depth_mm.at<float>(y, x);
      if (!(center > 0)) continue;
      int empty = 0;
      bool step = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const cv::Point p(x + dx, y + dy);
          const float z = grid.contains(p) ? depth_mm.at<float>(p) : 0;
          empty += !(z > 0);
          step |= z > 0 && std::abs(z - center) > jump_mm;
        }
      }
      if (step || empty >= 3) edges.at<uchar>(y, x) = 255;
    }
  }
  return edges;
}

// 255 where all labels within `radius` are the same.
cv::Mat uniform_labels(const cv::Mat& labels, int radius) {
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
  cv::Mat low, high;
  cv::erode(labels, low, window);
  cv::dilate(labels, high, window);
  return low == high;
}

}  // namespace

LabelledShot labelled_shot(const Shot& dressed, const SensorCalibration& sensor, const cv::Mat& labels,
                           const GarmentDepthParams& params) {
  LabelledShot shot;
  shot.depth_mm = corrected_depth_mm(dressed.depth_mm, sensor);
  shot.map = color_depth_map(shot.depth_mm, sensor, params.edge_jump_mm);
  const cv::Mat pixels = color_of_depth_pixels(shot.depth_mm, sensor, &shot.map);
  shot.label = to_depth(labels, pixels);
  const int radius = std::max(1, cvRound(params.ambiguous_px * labels.cols / 1920.0));
  const cv::Mat uniform = to_depth(uniform_labels(labels, radius), pixels);
  shot.certain = uniform & ~depth_edges(shot.depth_mm, params.edge_jump_mm);
  return shot;
}

cv::Mat garment_depth(const LabelledShot& shot, Label label) {
  cv::Mat depth = cv::Mat::zeros(shot.depth_mm.size(), CV_32F);
  shot.depth_mm.copyTo(depth, (shot.label == static_cast<int>(label)) & shot.certain);
  return depth;
}

}  // namespace dressform
