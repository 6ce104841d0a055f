#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "pipeline/segment/jseg_colors.h"

namespace dressform {
namespace {

constexpr int kHalf_px = 2;        // of the window
constexpr int kEnds = 3;           // gaps at either end of the sorted distances that are looked at for impulses
constexpr float kImpulseGap = 12;  // L*u*v* units
constexpr int kMost = (2 * kHalf_px + 1) * (2 * kHalf_px + 1);

struct Neighbour {
  float distance;
  cv::Vec3f color;
};

// A stretch of the sorted neighbours, [first, last).
struct Peers {
  int first, last;
};

// Without the impulses: what a wide gap parts from the rest at either end.
Peers without_impulses(const std::array<Neighbour, kMost>& sorted, int count) {
  Peers rest{0, count};
  if (count < 2 * kEnds) return rest;
  const auto gap = [&](int i) { return sorted[i + 1].distance - sorted[i].distance; };
  for (int i = 0; i < kEnds; ++i)
    if (gap(i) > kImpulseGap) rest.first = i + 1;
  for (int i = count - 2; i > count - 2 - kEnds && i >= rest.first; --i)
    if (gap(i) > kImpulseGap) rest.last = i + 1;
  return rest;
}

// Up to where the distances are one group: the cut with the least scatter for the distance of the two means.
Peers peer_group(const std::array<Neighbour, kMost>& sorted, const Peers& rest) {
  double sum = 0, squares = 0;
  for (int i = rest.first; i < rest.last; ++i)
    sum += sorted[i].distance, squares += static_cast<double>(sorted[i].distance) * sorted[i].distance;
  Peers best = rest;
  double least = std::numeric_limits<double>::infinity(), low = 0;
  for (int cut = rest.first + 1; cut < rest.last; ++cut) {
    low += sorted[cut - 1].distance;
    const int below = cut - rest.first, above = rest.last - cut;
    const double step = (sum - low) / above - low / below;
    if (!(step > 1e-6)) continue;
    const double scatter = std::max(0.0, squares - low * low / below - (sum - low) * (sum - low) / above);
    if (const double ratio = scatter / (step * step); ratio < least) least = ratio, best.last = cut;
  }
  return best;
}

int neighbours_of(const cv::Mat& luv, const cv::Mat& mask, int y, int x, std::array<Neighbour, kMost>& found) {
  const auto& center = luv.at<cv::Vec3f>(y, x);
  int count = 0;
  for (int dy = -kHalf_px; dy <= kHalf_px; ++dy) {
    const int row = std::clamp(y + dy, 0, luv.rows - 1);
    for (int dx = -kHalf_px; dx <= kHalf_px; ++dx) {
      const int column = std::clamp(x + dx, 0, luv.cols - 1);
      if (!mask.at<uchar>(row, column)) continue;
      const auto& color = luv.at<cv::Vec3f>(row, column);
      const cv::Vec3f d = color - center;
      found[count++] = {std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), color};
    }
  }
  std::sort(found.begin(), found.begin() + count,
            [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  return count;
}

}  // namespace

cv::Mat luv_of(const cv::Mat& bgr) {
  cv::Mat unit, luv;
  bgr.convertTo(unit, CV_32F, 1 / 255.0);
  cv::cvtColor(unit, luv, cv::COLOR_BGR2Luv);
  return luv;
}

PeerGroups peer_group_filtered(const cv::Mat& luv, const cv::Mat& mask) {
  PeerGroups result{luv.clone(), cv::Mat::zeros(luv.size(), CV_32F)};
  tbb::parallel_for(0, luv.rows, [&](int y) {
    std::array<Neighbour, kMost> sorted;
    for (int x = 0; x < luv.cols; ++x) {
      if (!mask.at<uchar>(y, x)) continue;
      const int count = neighbours_of(luv, mask, y, x, sorted);
      const Peers peers = peer_group(sorted, without_impulses(sorted, count));
      cv::Vec3f mean(0, 0, 0);
      for (int i = peers.first; i < peers.last; ++i) mean += sorted[i].color;
      result.luv.at<cv::Vec3f>(y, x) = mean * (1.0f / static_cast<float>(peers.last - peers.first));
      result.radius.at<float>(y, x) = sorted[peers.last - 1].distance;
    }
  });
  return result;
}

}  // namespace dressform
