#include "pipeline/segment/hem_evidence.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/segment/trunk_grid.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr float kMargin_m = 0.012, kWindow_m = 0.12;  // from the curve: what is asked
constexpr int kSectorColumns = 6;                     // 30 degrees learn, the next 30 are asked
constexpr double kFine_mm = 3.5;                      // pixels as far apart as that are asked
constexpr float kMostNats = 3;                        // that one pixel may say
constexpr std::array<float, 8> kGains{0.6f, 0.7f, 0.8f, 0.9f, 1.11f, 1.25f, 1.43f, 1.67f};

// Every step-th pixel of every step-th row.
cv::Mat thinned(const cv::Mat& image, int step) {
  if (image.empty() || step == 1) return image;
  cv::Mat result((image.rows + step - 1) / step, (image.cols + step - 1) / step, image.type());
  for (int v = 0; v < result.rows; ++v)
    for (int u = 0; u < result.cols; ++u)
      std::copy_n(image.ptr(v * step, u * step), image.elemSize(), result.ptr(v, u));
  return result;
}

bool beside(float height_m) { return std::abs(height_m) > kMargin_m && std::abs(height_m) < kWindow_m; }

struct Sides {
  std::vector<cv::Mat> above[2], below[2];  // by fold of sectors, by view: uint8
};

Sides sides_of(const std::vector<CurveOnView>& curve) {
  Sides sides;
  for (int fold = 0; fold < 2; ++fold) {
    sides.above[fold].resize(curve.size());
    sides.below[fold].resize(curve.size());
  }
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve[k].above_m.empty()) continue;
    const cv::Size size = curve[k].above_m.size();
    for (auto* side : {&sides.above, &sides.below})
      for (int fold = 0; fold < 2; ++fold) (*side)[fold][k] = cv::Mat::zeros(size, CV_8U);
    for (int v = 0; v < size.height; ++v) {
      for (int u = 0; u < size.width; ++u) {
        const float height = curve[k].above_m.at<float>(v, u);
        if (!beside(height)) continue;
        const int fold = curve[k].column.at<uchar>(v, u) / kSectorColumns % 2;
        (height > 0 ? sides.above : sides.below)[fold][k].at<uchar>(v, u) = 255;
      }
    }
  }
  return sides;
}

std::vector<cv::Mat> with_gain(const std::vector<cv::Mat>& images, float gain) {
  std::vector<cv::Mat> result;
  for (const cv::Mat& image : images) {
    cv::Mat scaled = image.clone();
    for (int v = 0; v < scaled.rows; ++v)
      for (int u = 0; u < scaled.cols; ++u) scaled.at<cv::Vec3b>(v, u) = shaded(scaled.at<cv::Vec3b>(v, u), gain);
    result.push_back(scaled);
  }
  return result;
}

// What the colours of one side said: 0 above, 1 below.
struct Answer {
  std::array<double, 2> nats{}, right{}, count{};

  double mean(const std::array<double, 2>& sums, int side) const {
    return count[side] > 0 ? sums[side] / count[side] : 0;
  }
  double nats_of_both() const { return (mean(nats, 0) + mean(nats, 1)) / 2; }
};

void ask(const cv::Mat& mask, const cv::Mat& image, const ColorHistogram& own, const ColorHistogram& other, int side,
         Answer& answer) {
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (!mask.at<uchar>(v, u)) continue;
      const auto& color = image.at<cv::Vec3b>(v, u);
      const float nats = own.log_density(color) - other.log_density(color);
      answer.nats[side] += std::clamp(nats, -kMostNats, kMostNats);
      answer.right[side] += nats > 0;
      ++answer.count[side];
    }
  }
}

// By view, the lower side lit by `gain`.
std::vector<Answer> answers(const Sides& sides, const std::vector<cv::Mat>& images, float gain) {
  const auto lit = with_gain(images, gain);
  std::vector<Answer> result(images.size());
  for (int fold = 0; fold < 2; ++fold) {
    const auto above = shared_models(sides.above[fold], images), below = shared_models(sides.below[fold], lit);
    tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t k) {
      if (sides.above[fold][k].empty()) return;
      ask(sides.above[1 - fold][k], images[k], above[k], below[k], 0, result[k]);
      ask(sides.below[1 - fold][k], lit[k], below[k], above[k], 1, result[k]);
    });
  }
  return result;
}

}  // namespace

HemEvidence hem_evidence(const std::vector<ViewEvidence>& views, const std::vector<CurveOnView>& curve) {
  std::vector<cv::Mat> images;
  std::vector<CurveOnView> asked;
  std::vector<double> px_mm2;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const double px_mm = views[k].box.empty() ? 1 : pixel_size_mm(views[k]);
    const int step = std::max(1, static_cast<int>(kFine_mm / px_mm));
    images.push_back(thinned(views[k].lab, step));
    asked.push_back({thinned(curve[k].above_m, step), thinned(curve[k].column, step)});
    px_mm2.push_back(std::pow(px_mm * step, 2));
  }
  const Sides sides = sides_of(asked);
  std::vector<Answer> alike = answers(sides, images, 1);  // under the gain that brings the sides closest
  for (const float gain : kGains) {
    const auto found = answers(sides, images, gain);
    for (std::size_t k = 0; k < views.size(); ++k)
      if (found[k].nats_of_both() < alike[k].nats_of_both()) alike[k] = found[k];
  }
  HemEvidence evidence;
  double sum = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (curve[k].above_m.empty()) continue;
    const double weight = std::min(alike[k].count[0], alike[k].count[1]) * px_mm2[k];
    evidence.below_mm2 += alike[k].count[1] * px_mm2[k];
    evidence.color_nats += weight * alike[k].nats_of_both();
    evidence.told_above += weight * alike[k].mean(alike[k].right, 0);
    evidence.told_below += weight * alike[k].mean(alike[k].right, 1);
    sum += weight;
  }
  if (sum == 0) return evidence;
  evidence.color_nats /= sum;
  evidence.told_above /= sum;
  evidence.told_below /= sum;
  return evidence;
}

}  // namespace dressform
