#include "pipeline/segment/view_models.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kPairShare = 0.15;                          // of the other views' colours in a view's model
constexpr std::array<float, 3> kShades{0.75f, 0.55f, 0.4f};  // of a colour's 8-bit values where little light falls
constexpr float kShadeShare = 0.1f;

}  // namespace

cv::Vec3b shaded(const cv::Vec3b& lab, float gain) {
  return {cv::saturate_cast<uchar>(gain * lab[0]), cv::saturate_cast<uchar>(128 + gain * (lab[1] - 128)),
          cv::saturate_cast<uchar>(128 + gain * (lab[2] - 128))};
}

std::vector<ColorHistogram> shared_models(const std::vector<cv::Mat>& masks, const std::vector<cv::Mat>& images,
                                          bool shades) {
  std::vector<ColorHistogram> models(masks.size());
  std::vector<double> counts;
  double all = 0;
  for (const cv::Mat& mask : masks) {
    counts.push_back(mask.empty() ? 0 : cv::countNonZero(mask));
    all += counts.back();
  }
  tbb::parallel_for(std::size_t{0}, masks.size(), [&](std::size_t k) {
    for (std::size_t other = 0; other < masks.size(); ++other) {
      if (counts[other] == 0 || (other != k && all <= counts[k])) continue;
      const double pooled = counts[k] > 0 ? kPairShare * counts[k] / (all - counts[k]) : 1;
      const float weight = other == k ? 1.f : static_cast<float>(pooled);
      for (int v = 0; v < masks[other].rows; ++v) {
        for (int u = 0; u < masks[other].cols; ++u) {
          if (!masks[other].at<uchar>(v, u)) continue;
          const auto& lab = images[other].at<cv::Vec3b>(v, u);
          models[k].add(lab, weight);
          for (std::size_t s = 0; shades && s < kShades.size(); ++s)
            models[k].add(shaded(lab, kShades[s]), kShadeShare * weight);
        }
      }
    }
    models[k].finish();
  });
  return models;
}

cv::Mat eroded(const cv::Mat& mask, int times) {
  cv::Mat result;
  cv::erode(mask, result, cv::Mat(), {-1, -1}, times, cv::BORDER_CONSTANT, cv::Scalar(0));
  return result;
}

std::vector<cv::Mat> lab_images(const std::vector<ViewEvidence>& views) {
  std::vector<cv::Mat> images;
  for (const ViewEvidence& view : views) images.push_back(view.lab);
  return images;
}

double pixel_size_mm(const ViewEvidence& view) {
  std::vector<float> sizes;
  for (int v = 0; v < view.box.height; v += 4) {
    for (int u = 0; u + 8 < view.box.width; u += 4) {
      const cv::Vec3f step = view.place_m.at<cv::Vec3f>(v, u + 8) - view.place_m.at<cv::Vec3f>(v, u);
      const double length = cv::norm(step);
      if (length > 0) sizes.push_back(static_cast<float>(1000 * length / 8));  // false for NaN
    }
  }
  if (sizes.empty()) return 2;
  // The smaller ones face the camera.
  const std::size_t quarter = sizes.size() / 4;
  return std::max(0.2, static_cast<double>(nth_value(std::move(sizes), quarter)));
}

void remove_specks(cv::Mat& mask, const cv::Mat& body, double speck_mm2, double px_mm) {
  const int least_px = static_cast<int>(speck_mm2 / (px_mm * px_mm));
  for (const int value : {255, 0}) {
    cv::Mat labels, stats, centers;
    const cv::Mat pieces = (mask == value) & body;
    const int count = cv::connectedComponentsWithStats(pieces, labels, stats, centers, 4);
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        const int label = labels.at<int>(y, x);
        if (label > 0 && label < count && stats.at<int>(label, cv::CC_STAT_AREA) < least_px)
          mask.at<uchar>(y, x) = static_cast<uchar>(255 - value);
      }
    }
  }
}

}  // namespace dressform
