#include "pipeline/fill/holes.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dressform {
namespace {

constexpr int kSweeps = 600;
constexpr float kOverRelaxation = 1.85f;

// What a pixel is to the garment: its own, something worn in front, without depth, or the room.
enum Kind { kOwn, kOther, kEmpty, kRoom };

Kind kind_of(const LabelledShot& shot, Label label, int y, int x) {
  const int found = shot.label.at<uchar>(y, x);
  if (found == static_cast<int>(label)) return kOwn;
  if (found != 0) return kOther;
  return shot.depth_mm.at<float>(y, x) > 0 ? kRoom : kEmpty;
}

// Marks the runs of others between two runs of the garment in one row. Pixels at the edge of what hides may have lost
// their label to the parallax of the two cameras, or show the room in a mixed pixel: `bridge_px` of these are crossed.
void mark_row(const LabelledShot& shot, Label label, int y, const HoleParams& params, cv::Mat& hole) {
  int own = 0, others = 0, unknown = 0, start = -1;
  for (int x = 0; x < hole.cols; ++x) {
    const Kind kind = kind_of(shot, label, y, x);
    if (kind == kOwn) {
      if (start >= 0 && others > 0) {
        for (int k = start; k < x; ++k) hole.at<uchar>(y, k) = 255;
      }
      own = start >= 0 ? 1 : own + 1;
      start = -1;
      continue;
    }
    if (start < 0 && own < params.side_px) {
      own = 0;
      continue;
    }
    if (start < 0) {
      start = x;
      others = unknown = 0;
    }
    unknown = kind == kOther ? 0 : unknown + 1;
    others += kind == kOther;
    if (unknown > params.bridge_px) {
      start = -1;
      own = 0;
    }
  }
}

// Depth, mm, of the limbless body along every pixel of the domain and its surroundings; 0 = missed.
cv::Mat body_depth_mm(const cv::Mat& wanted, const Camera& ir, const Isometry3d& model_from_sensor,
                      const MeshQuery& body) {
  cv::Mat depth = cv::Mat::zeros(wanted.size(), CV_32F);
  for (int y = 0; y < wanted.rows; ++y) {
    for (int x = 0; x < wanted.cols; ++x) {
      if (!wanted.at<uchar>(y, x)) continue;
      const Vector3d ray = model_from_sensor.linear() * ir.unproject(Vector2d(x, y), 1);
      if (const auto hit = body.first_hit(model_from_sensor.translation(), ray))
        depth.at<float>(y, x) = static_cast<float>(1000 * hit->distance);
    }
  }
  return depth;
}

// Drops pieces that are small, or of which a large part fails the test.
cv::Mat accepted(const cv::Mat& hole, const cv::Mat& passes, int least_px) {
  cv::Mat labels, result = cv::Mat::zeros(hole.size(), CV_8U);
  const int count = cv::connectedComponents(hole, labels, 4);
  std::vector<int> size(count, 0), good(count, 0);
  for (int y = 0; y < hole.rows; ++y) {
    for (int x = 0; x < hole.cols; ++x) {
      ++size[labels.at<int>(y, x)];
      good[labels.at<int>(y, x)] += passes.at<uchar>(y, x) != 0;
    }
  }
  for (int y = 0; y < hole.rows; ++y) {
    for (int x = 0; x < hole.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && passes.at<uchar>(y, x) && good[label] >= least_px && 5 * good[label] >= 3 * size[label])
        result.at<uchar>(y, x) = 255;
    }
  }
  return result;
}

}  // namespace

cv::Mat membrane(const cv::Mat& values, const cv::Mat& known, const cv::Mat& domain) {
  cv::Mat result = values.clone();
  const cv::Rect grid({0, 0}, values.size());
  const cv::Point steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  std::vector<cv::Point> cells;
  double sum = 0;
  int count = 0;
  for (int y = 0; y < domain.rows; ++y) {
    for (int x = 0; x < domain.cols; ++x) {
      if (domain.at<uchar>(y, x)) {
        cells.emplace_back(x, y);
      } else if (known.at<uchar>(y, x)) {
        sum += values.at<float>(y, x);
        ++count;
      }
    }
  }
  for (const cv::Point& cell : cells) result.at<float>(cell) = count ? static_cast<float>(sum / count) : 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const cv::Point& cell : cells) {
      float around = 0;
      int neighbours = 0;
      for (const cv::Point& step : steps) {
        const cv::Point next = cell + step;
        if (!grid.contains(next) || (!domain.at<uchar>(next) && !known.at<uchar>(next))) continue;
        around += result.at<float>(next);
        ++neighbours;
      }
      if (neighbours == 0) continue;
      float& value = result.at<float>(cell);
      value += kOverRelaxation * (around / static_cast<float>(neighbours) - value);
    }
  }
  return result;
}

cv::Mat hidden_depth(const LabelledShot& shot, Label label, const cv::Mat& seen_mm, const Camera& ir,
                     const Isometry3d& model_from_sensor, const MeshQuery& body, const HoleParams& params) {
  cv::Mat hole = cv::Mat::zeros(seen_mm.size(), CV_8U), filled = cv::Mat::zeros(seen_mm.size(), CV_32F);
  for (int y = 0; y < hole.rows; ++y) mark_row(shot, label, y, params, hole);
  if (cv::countNonZero(hole) == 0) return filled;

  // The garment's own pixels beside the hole were dropped as edges: the membrane runs on to the certain ones.
  cv::Mat near;
  cv::dilate(hole, near, cv::Mat(), {-1, -1}, 3);
  const cv::Mat own = shot.label == static_cast<int>(label);
  const cv::Mat domain = hole | (near & own & (seen_mm == 0));
  const cv::Mat body_mm = body_depth_mm(near, ir, model_from_sensor, body);
  cv::Mat gap = body_mm - seen_mm;
  cv::Mat known = (seen_mm > 0) & (body_mm > 0) & (domain == 0);
  known &= cv::abs(gap) < 250;
  gap = membrane(gap, known, domain);
  const cv::Mat depth = body_mm - gap;
  const cv::Mat measured = shot.depth_mm;
  const cv::Mat free = (measured == 0) | (depth > measured + params.nearer_mm);
  accepted(hole, free & (body_mm > 0), params.least_px).copyTo(hole);
  depth.copyTo(filled, hole);
  return filled;
}

}  // namespace dressform
