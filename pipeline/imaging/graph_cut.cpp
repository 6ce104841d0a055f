#include "pipeline/imaging/graph_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace dressform {
namespace {

// Half of the 8 neighbours: every edge once.
struct Step {
  cv::Point to;
  float distance;
};
const std::array<Step, 4> kSteps{{{{1, 0}, 1.f}, {{0, 1}, 1.f}, {{1, 1}, 1.41421356f}, {{-1, 1}, 1.41421356f}}};

float squared_difference(const cv::Vec3b& a, const cv::Vec3b& b) {
  float sum = 0;
  for (int k = 0; k < 3; ++k) sum += static_cast<float>((a[k] - b[k]) * (a[k] - b[k]));
  return sum;
}

// 1 / (2 sigma^2) from the mean squared difference of neighbours in the active region.
float contrast_scale(const cv::Mat& color, const cv::Mat& active) {
  const cv::Rect grid({0, 0}, color.size());
  double sum = 0;
  long count = 0;
  for (int y = 0; y < color.rows; ++y) {
    for (int x = 0; x < color.cols; ++x) {
      if (!active.at<uchar>(y, x)) continue;
      for (const Step& step : kSteps) {
        const cv::Point next = cv::Point(x, y) + step.to;
        if (!grid.contains(next)) continue;
        sum += squared_difference(color.at<cv::Vec3b>(y, x), color.at<cv::Vec3b>(next));
        ++count;
      }
    }
  }
  return sum > 0 ? static_cast<float>(count / sum) : 0.f;
}

}  // namespace

cv::Mat binary_cut(const cv::Mat& color, const cv::Mat& ones_cost, const cv::Mat& active, const cv::Mat& initial,
                   const CutSmoothness& smoothness) {
  const cv::Rect grid({0, 0}, color.size());
  cv::Mat node(color.size(), CV_32S, cv::Scalar(-1));
  int nodes = 0;
  for (int y = 0; y < color.rows; ++y)
    for (int x = 0; x < color.cols; ++x)
      if (active.at<uchar>(y, x)) node.at<int>(y, x) = nodes++;
  cv::Mat result = initial.clone();
  if (nodes == 0) return result;

  cv::detail::GCGraph<float> graph(static_cast<unsigned>(nodes), static_cast<unsigned>(8 * nodes));
  for (int k = 0; k < nodes; ++k) graph.addVtx();
  const float scale = contrast_scale(color, active);
  const auto weight = [&](const cv::Point& a, const cv::Point& b, float distance) {
    const float same = std::exp(-scale * squared_difference(color.at<cv::Vec3b>(a), color.at<cv::Vec3b>(b)));
    return static_cast<float>(smoothness.strength) * std::max(same, static_cast<float>(smoothness.floor)) / distance;
  };
  const auto hold = [&](int vertex, const cv::Point& fixed, float w) {
    const bool one = initial.at<uchar>(fixed) != 0;
    graph.addTermWeights(vertex, one ? w : 0, one ? 0 : w);
  };
  for (int y = 0; y < color.rows; ++y) {
    for (int x = 0; x < color.cols; ++x) {
      const cv::Point at(x, y);
      const int a = node.at<int>(at);
      if (a >= 0) {
        const float cost = ones_cost.at<float>(at);
        graph.addTermWeights(a, std::max(0.f, -cost), std::max(0.f, cost));
      }
      for (const Step& step : kSteps) {
        const cv::Point next = at + step.to;
        if (!grid.contains(next)) continue;
        const int b = node.at<int>(next);
        if (a < 0 && b < 0) continue;
        const float w = weight(at, next, step.distance);
        if (a >= 0 && b >= 0)
          graph.addEdges(a, b, w, w);
        else if (a >= 0)
          hold(a, next, w);
        else
          hold(b, at, w);
      }
    }
  }
  graph.maxFlow();
  for (int y = 0; y < color.rows; ++y)
    for (int x = 0; x < color.cols; ++x)
      if (const int a = node.at<int>(y, x); a >= 0) result.at<uchar>(y, x) = graph.inSourceSegment(a) ? 255 : 0;
  return result;
}

}  // namespace dressform
