#include "pipeline/segment/color_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scenes/statistics.h"

namespace dressform {

const float kShadowUnits = 3;

namespace {

constexpr float kDarkestShadow = 0.25f, kBrightest = 1.1f;  // gains that shadows and reflections may have

float median_of_enough(std::vector<float> values, float otherwise) {
  constexpr std::size_t kEnough = 100;  // pixels: fewer may be of one thing that changed
  return values.size() < kEnough ? otherwise : median(std::move(values));
}

struct Match {
  std::array<float, 3> gain{1, 1, 1};
  float noise = 2;
};

Match match_exposure(const cv::Mat& dressed, const cv::Mat& naked, const cv::Mat& body) {
  std::array<std::vector<float>, 3> ratios;
  std::vector<float> residuals;
  const auto each = [&](const auto& visit) {
    for (int y = 0; y < body.rows; y += 3)
      for (int x = 0; x < body.cols; x += 3)
        if (!body.at<uchar>(y, x)) visit(dressed.at<cv::Vec3b>(y, x), naked.at<cv::Vec3b>(y, x));
  };
  each([&](const cv::Vec3b& a, const cv::Vec3b& b) {
    for (int k = 0; k < 3; ++k)
      if (b[k] > 25 && b[k] < 235 && a[k] < 250)
        ratios[k].push_back(static_cast<float>(a[k]) / static_cast<float>(b[k]));
  });
  Match match;
  for (int k = 0; k < 3; ++k) match.gain[k] = std::clamp(median_of_enough(std::move(ratios[k]), 1.f), 0.4f, 2.5f);
  each([&](const cv::Vec3b& a, const cv::Vec3b& b) {
    float largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(a[k] - match.gain[k] * b[k]));
    residuals.push_back(largest);
  });
  match.noise = std::clamp(median_of_enough(std::move(residuals), 2.f), 1.f, 8.f);
  return match;
}

// Largest channel difference of a and k b.
float difference(const cv::Vec3f& a, const cv::Vec3f& b, float k) {
  return std::max({std::abs(a[0] - k * b[0]), std::abs(a[1] - k * b[1]), std::abs(a[2] - k * b[2])});
}

struct Change {
  float levels = 0;
  bool shadow = false;
};

Change change_of(const cv::Vec3f& dressed, const cv::Vec3f& naked, float noise) {
  const float plain = difference(dressed, naked, 1);
  const float norm = naked.dot(naked);
  if (!(norm > 1)) return {plain, false};
  const float shadow = std::clamp(dressed.dot(naked) / norm, kDarkestShadow, kBrightest);
  const float shaded = difference(dressed, naked, shadow);
  // A mere shadow is neither the same nor a change.
  const float least = kShadowUnits * noise;
  return {std::min(plain, std::max(shaded, least)), plain > least && shaded < least && shadow < 1};
}

}  // namespace

ColorChange color_change(const cv::Mat& dressed_bgr, const cv::Mat& naked_bgr, const cv::Mat& body,
                         const cv::Rect& box) {
  cv::Mat dressed, naked;
  cv::GaussianBlur(dressed_bgr, dressed, cv::Size(3, 3), 0);
  cv::GaussianBlur(naked_bgr, naked, cv::Size(3, 3), 0);
  const Match match = match_exposure(dressed, naked, body);
  ColorChange result{cv::Mat(box.size(), CV_32F), cv::Mat::zeros(box.size(), CV_8U), cv::Mat(box.size(), CV_8UC3)};
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) {
      const cv::Point at(x + box.x, y + box.y);
      const cv::Vec3f a = dressed.at<cv::Vec3b>(at);
      cv::Vec3f b = naked.at<cv::Vec3b>(at);
      const cv::Vec3b raw = naked_bgr.at<cv::Vec3b>(at);
      for (int k = 0; k < 3; ++k) {
        b[k] *= match.gain[k];
        result.matched_naked.at<cv::Vec3b>(y, x)[k] = cv::saturate_cast<uchar>(match.gain[k] * raw[k]);
      }
      const Change change = change_of(a, b, match.noise);
      result.units.at<float>(y, x) = change.levels / match.noise;
      if (change.shadow) result.shadow.at<uchar>(y, x) = 255;
    }
  }
  return result;
}

}  // namespace dressform
