#include "scenes/session_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>

namespace dressform {
namespace {

constexpr int kNone = 65535;         // 0xFFFF: the largest value is no measurement but "none" or "saturated"
constexpr double kCodePart = 0.005;  // of the pixels at exactly one largest value: no noisy surface does that
constexpr double kNearPart = 0.1, kFarPart = 0.5;  // of the pixels that must be as near, or as far, as can be
constexpr int kStride = 7;  // every seventh pixel is counted: reading a session stays as quick as it was

int largest(const cv::Mat& depth) {
  std::uint16_t most = 0;
  for (int y = 0; y < depth.rows; ++y) {
    const auto* row = depth.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) most = std::max(most, row[x]);
  }
  return most;
}

// The scale in which these distances would be those of a person before a camera.
std::string scale_guess(double middle_m, double per_m) {
  struct Scale {
    const char* name;
    double per_m;
  };
  constexpr double kUsualLeast_m = 0.6, kUsualMost_m = 5;
  for (const Scale& scale : {Scale{"metres", 1},
                             {"centimetres, 100 a metre", 100},
                             {"millimetres, 1000 a metre", 1000},
                             {"5000 a metre", 5000},
                             {"10000 a metre", 10000},
                             {"4000 a metre", 4000}}) {
    const double middle = middle_m * per_m / scale.per_m;
    if (scale.per_m != per_m && middle > kUsualLeast_m && middle < kUsualMost_m)
      return fmt::format(" (looks like {})", scale.name);
  }
  return {};
}

}  // namespace

void DepthTally::add(const cv::Mat& depth_mm) {
  const auto total = static_cast<long>(depth_mm.total());
  const cv::Mat dense = depth_mm.isContinuous() ? depth_mm : depth_mm.clone();
  const auto* values = dense.ptr<std::uint16_t>();
  for (long i = 0; i < total; i += kStride) {
    ++sampled_;
    if (values[i] == 0) continue;
    ++valid_;
    ++bins_[values[i] >> kShift];
  }
}

void DepthTally::add(const DepthTally& other) {
  sampled_ += other.sampled_;
  valid_ += other.valid_;
  for (int i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
}

double DepthTally::quantile_m(double part) const {
  const double wanted = part * static_cast<double>(valid_);
  double seen = 0;
  for (int i = 0; i < kBins; ++i)
    if (bins_[i] > 0 && (seen += bins_[i]) >= wanted) return 1e-3 * ((i << kShift) + (1 << (kShift - 1)));
  return 0;
}

std::optional<int> saturation_code(const cv::Mat& depth) {
  const int most = largest(depth);
  if (most == kNone) return kNone;
  for (const int code : {2047, 4095, 8191, 16383, 32767})
    if (most == code && cv::countNonZero(depth == code) > kCodePart * static_cast<double>(depth.total())) return code;
  return {};
}

std::string problem_with_depth_code(const cv::Mat& depth_mm) {
  const auto code = saturation_code(depth_mm);
  if (!code) return {};
  const int count = cv::countNonZero(depth_mm == *code);
  return fmt::format(
      "found {} (0x{:X}) in {} of {} pixels, {:.1f} m if it were depth, which is what recorders write where there is "
      "no "
      "depth; expected millimetres, and 0 for none",
      *code, *code, count, depth_mm.total(), 1e-3 * *code);
}

std::string problem_with_depth(const DepthTally& tally, const DepthRange& range, double per_m) {
  if (tally.sampled() == 0) return {};
  if (tally.valid() == 0)
    return "found no pixel with depth, all are 0; expected the depth that the sensor measured (where it measured none, "
           "leave it out)";
  const double near_m = tally.quantile_m(kNearPart), middle_m = tally.quantile_m(kFarPart);
  if (near_m >= range.nearest_m && middle_m <= range.farthest_m) return {};
  return fmt::format(
      "found depth of {:.2f} m in the middle ({:.2f} to {:.2f} m in 80 % of the pixels); expected {:g} to {:g} m, "
      "where "
      "a depth camera sees a person or a room{}",
      middle_m, near_m, tally.quantile_m(1 - kNearPart), range.nearest_m, range.farthest_m,
      scale_guess(middle_m, per_m));
}

}  // namespace dressform
