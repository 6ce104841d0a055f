#include "pipeline/fill/holes.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dressform {
namespace {

constexpr int kSweeps = 600;
constexpr double kLeastCosine = 0.25;  // grazing body says little of the gap
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

// The limbless body along every wanted pixel. A ray that meets the inside, through the opening an arm left, misses.
struct BodyMap {
  cv::Mat depth_mm;  // 0 = missed
  cv::Mat cosine;    // between the line of sight and the surface's normal
};

BodyMap body_map(const cv::Mat& wanted, const Camera& ir, const Isometry3d& model_from_sensor, const MeshQuery& body) {
  BodyMap map{cv::Mat::zeros(wanted.size(), CV_32F), cv::Mat::ones(wanted.size(), CV_32F)};
  for (int y = 0; y < wanted.rows; ++y) {
    for (int x = 0; x < wanted.cols; ++x) {
      if (!wanted.at<uchar>(y, x)) continue;
      const Vector3d ray = model_from_sensor.linear() * ir.unproject(Vector2d(x, y), 1);
      const auto hit = body.first_hit(model_from_sensor.translation(), ray);
      if (!hit) continue;
      const double cosine = -body.normal(hit->triangle).dot(ray) / ray.norm();
      if (cosine < kLeastCosine) continue;
      map.depth_mm.at<float>(y, x) = static_cast<float>(1000 * hit->distance);
      map.cosine.at<float>(y, x) = static_cast<float>(cosine);
    }
  }
  return map;
}

// 255 where a seen pixel is nearer to the arms than to the trunk.
cv::Mat on_the_arms(const cv::Mat& wanted, const cv::Mat& seen_mm, const Camera& ir,
                    const Isometry3d& model_from_sensor, const PartedBody& body) {
  cv::Mat arms = cv::Mat::zeros(wanted.size(), CV_8U);
  for (int y = 0; y < wanted.rows; ++y) {
    for (int x = 0; x < wanted.cols; ++x) {
      const float z = seen_mm.at<float>(y, x);
      if (!wanted.at<uchar>(y, x) || !(z > 0)) continue;
      const Vector3d point = model_from_sensor * ir.unproject(Vector2d(x, y), z / 1000);
      if (body.arms.closest(point).distance < body.trunk.closest(point).distance) arms.at<uchar>(y, x) = 255;
    }
  }
  return arms;
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
                     const Isometry3d& model_from_sensor, const PartedBody& body, const HoleParams& params) {
  cv::Mat hole = cv::Mat::zeros(seen_mm.size(), CV_8U), filled = cv::Mat::zeros(seen_mm.size(), CV_32F);
  for (int y = 0; y < hole.rows; ++y) mark_row(shot, label, y, params, hole);
  if (cv::countNonZero(hole) == 0) return filled;
  const cv::Mat upright = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(1, 5));
  cv::morphologyEx(hole, hole, cv::MORPH_CLOSE, upright);
  hole.setTo(0, shot.label == static_cast<int>(label));

  // The garment's own pixels beside the hole were dropped as edges: the membrane runs on to the certain ones.
  cv::Mat near;
  cv::dilate(hole, near, cv::Mat(), {-1, -1}, 3);
  const cv::Mat own = shot.label == static_cast<int>(label);
  const cv::Mat domain = hole | (near & own & (seen_mm == 0));
  const BodyMap limbless = body_map(near, ir, model_from_sensor, body.trunk);
  // Cloth keeps its distance along the normal, not along the line of sight.
  cv::Mat gap = (limbless.depth_mm - seen_mm).mul(limbless.cosine);
  const cv::Mat known = (seen_mm > 0) & (limbless.depth_mm > 0) & (domain == 0) & (cv::abs(gap) < 200) &
                        ~on_the_arms(near, seen_mm, ir, model_from_sensor, body);
  gap = membrane(gap, known, domain);
  const cv::Mat depth = limbless.depth_mm - gap / limbless.cosine;
  const cv::Mat measured = shot.depth_mm;
  const cv::Mat free = (measured == 0) | (depth > measured + params.nearer_mm);
  accepted(hole, free & (limbless.depth_mm > 0), params.least_px).copyTo(hole);
  depth.copyTo(filled, hole);
  return filled;
}

}  // namespace dressform
