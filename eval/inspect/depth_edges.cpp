#include "eval/inspect/depth_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dressform {
namespace {

constexpr int kSteady = 3, kApart = 6;

// How far neighbours on one surface may differ.
double steady_mm(double mm) { return std::max(20.0, 10e-6 * mm * mm); }

struct Run {
  int begin = 0, end = 0;
};

std::vector<Run> steady_runs(const std::uint16_t* row, int columns) {
  std::vector<Run> runs;
  for (int x = 0; x < columns;) {
    int end = x + 1;
    while (end < columns && row[x] && row[end] && std::abs(row[end] - row[end - 1]) < steady_mm(row[end])) ++end;
    if (row[x] && end - x >= kSteady) runs.push_back({x, end});
    x = end;
  }
  return runs;
}

}  // namespace

void count_edges(const cv::Mat& depth_mm, std::vector<DepthEdges>& edges) {
  if (edges.empty()) {
    const double ends[] = {0.1, 0.2, 0.4, 0.8, 1.6, std::numeric_limits<double>::infinity()};
    for (int i = 0; i < 5; ++i) edges.push_back({ends[i], ends[i + 1], 0, 0, 0});
  }
  for (int y = 0; y < depth_mm.rows; ++y) {
    const auto* row = depth_mm.ptr<std::uint16_t>(y);
    const auto runs = steady_runs(row, depth_mm.cols);
    for (std::size_t i = 1; i < runs.size(); ++i) {
      const int before = row[runs[i - 1].end - 1], after = row[runs[i].begin];
      const double step_m = 1e-3 * std::abs(after - before);
      if (runs[i].begin - runs[i - 1].end > kApart) continue;
      for (auto& edge : edges) {
        if (step_m < edge.from_m || step_m >= edge.to_m) continue;
        ++edge.crossings;
        for (int x = runs[i - 1].end; x < runs[i].begin; ++x) {
          edge.lost += row[x] == 0;
          edge.flying += row[x] > std::min(before, after) + steady_mm(before) / 2 &&
                         row[x] < std::max(before, after) - steady_mm(after) / 2;
        }
      }
    }
  }
}

}  // namespace dressform
