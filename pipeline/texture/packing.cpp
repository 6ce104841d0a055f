#include "pipeline/texture/packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dressform {
namespace {

constexpr double kWaste = 1.1;  // of the boxes' area: what is left free between them
constexpr int kStep = 4;        // boxes start at multiples of this

int rounded_up(int value) { return (value + kStep - 1) / kStep * kStep; }

}  // namespace

Packing pack(const std::vector<cv::Size>& boxes) {
  Packing packing;
  packing.at.resize(boxes.size());
  double area = 0;
  int widest = kStep;
  for (const cv::Size& box : boxes) {
    area += static_cast<double>(box.area());
    widest = std::max(widest, box.width);
  }
  const int width = rounded_up(std::max(widest, static_cast<int>(std::ceil(std::sqrt(area * kWaste)))));
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    if (boxes[a].height != boxes[b].height) return boxes[a].height > boxes[b].height;
    return boxes[a].width != boxes[b].width ? boxes[a].width > boxes[b].width : a < b;
  });
  std::vector<int> skyline(width / kStep, 0);
  int height = kStep;
  for (const int i : order) {
    const int columns = rounded_up(boxes[i].width) / kStep;
    int best = 0, lowest = std::numeric_limits<int>::max();
    for (int x = 0; x + columns <= static_cast<int>(skyline.size()); ++x) {
      const int top = *std::max_element(skyline.begin() + x, skyline.begin() + x + columns);
      if (top < lowest) {
        lowest = top;
        best = x;
      }
    }
    packing.at[i] = {best * kStep, lowest};
    std::fill(skyline.begin() + best, skyline.begin() + best + columns, lowest + boxes[i].height);
    height = std::max(height, lowest + boxes[i].height);
  }
  packing.size = {width, rounded_up(height)};
  return packing;
}

}  // namespace dressform
