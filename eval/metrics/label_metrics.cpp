#include "eval/metrics/label_metrics.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/metrics/surface_metrics.h"

namespace dressform::metrics {
namespace {

cv::Mat outline(const cv::Mat& mask) {
  cv::Mat inner;
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  cv::erode(mask, inner, cross, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return mask & ~inner;
}

// Part of the pixels of `outline` that lie within the tolerance of `other`.
double share_near(const cv::Mat& outline, const cv::Mat& other, double tolerance_px) {
  cv::Mat distance;
  cv::distanceTransform(~other, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat near = outline & (distance <= tolerance_px);
  return static_cast<double>(cv::countNonZero(near)) / cv::countNonZero(outline);
}

double share(const cv::Mat& part, const cv::Mat& whole) {
  const int count = cv::countNonZero(whole);
  return count ? static_cast<double>(cv::countNonZero(part & whole)) / count : 0;
}

}  // namespace

double label_iou(const cv::Mat& estimate, const cv::Mat& truth, std::uint8_t label) {
  const cv::Mat a = estimate == label, b = truth == label;
  const int all = cv::countNonZero(a | b);
  return all ? static_cast<double>(cv::countNonZero(a & b)) / all : 1;
}

double boundary_f(const cv::Mat& estimate, const cv::Mat& truth, std::uint8_t label, double tolerance_px) {
  const cv::Mat a = estimate == label, b = truth == label;
  cv::Rect box = cv::boundingRect(a | b);
  if (box.area() == 0) return 1;
  const int margin = static_cast<int>(tolerance_px) + 2;
  box = cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
        cv::Rect({0, 0}, truth.size());
  const cv::Mat lines_a = outline(a)(box), lines_b = outline(b)(box);
  const bool some_a = cv::countNonZero(lines_a) > 0, some_b = cv::countNonZero(lines_b) > 0;
  if (!some_a || !some_b) return some_a == some_b ? 1 : 0;
  return f_score(share_near(lines_a, lines_b, tolerance_px), share_near(lines_b, lines_a, tolerance_px));
}

double foreground_leakage(const cv::Mat& estimate, const cv::Mat& truth) { return share(truth == 0, estimate > 0); }

double foreground_miss(const cv::Mat& estimate, const cv::Mat& truth) { return share(estimate == 0, truth > 0); }

}  // namespace dressform::metrics
