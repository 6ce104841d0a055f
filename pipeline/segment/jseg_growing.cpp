#include "pipeline/segment/jseg_growing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <queue>
#include <tuple>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

constexpr std::array<double, 6> kThresholds = {-0.6, -0.4, -0.2, 0, 0.2, 0.4};  // standard deviations off the mean
constexpr std::array<std::array<int, 2>, 4> kSteps = {{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};  // x, y

// Calls visit(v, u) for the 4-neighbours of (y, x) in the image.
template <class Visit>
void for_neighbours(const cv::Size& size, int y, int x, const Visit& visit) {
  for (const auto& [dx, dy] : kSteps)
    if (x + dx >= 0 && y + dy >= 0 && x + dx < size.width && y + dy < size.height) visit(y + dy, x + dx);
}

int largest_label(const cv::Mat& labels) {
  double most = 0;
  cv::minMaxLoc(labels, nullptr, &most);
  return static_cast<int>(most);
}

struct Statistics {
  double count = 0, sum = 0, squares = 0;
  double mean() const { return count > 0 ? sum / count : 0; }
  double deviation() const { return std::sqrt(std::max(0.0, squares / std::max(1.0, count) - mean() * mean())); }
};

// Of j by region, index 0 unused.
std::vector<Statistics> statistics(const cv::Mat& j, const cv::Mat& regions) {
  std::vector<Statistics> result(static_cast<std::size_t>(largest_label(regions)) + 1);
  for (int y = 0; y < j.rows; ++y) {
    for (int x = 0; x < j.cols; ++x) {
      Statistics& s = result[regions.at<int>(y, x)];
      const double value = j.at<float>(y, x);
      s.count += 1, s.sum += value, s.squares += value * value;
    }
  }
  return result;
}

// The pixels of `regions` whose J is at most their region's threshold, or below it.
cv::Mat low_pixels(const cv::Mat& j, const cv::Mat& regions, const std::vector<double>& thresholds, bool equal_too) {
  cv::Mat low = cv::Mat::zeros(regions.size(), CV_32S);
  for (int y = 0; y < regions.rows; ++y) {
    for (int x = 0; x < regions.cols; ++x) {
      const int region = regions.at<int>(y, x);
      const float value = j.at<float>(y, x);
      const auto threshold = static_cast<float>(thresholds[region]);
      if (region && (value < threshold || (equal_too && value == threshold))) low.at<int>(y, x) = region;
    }
  }
  return low;
}

// Which of the seeds a piece touches.
struct Touch {
  int seed = 0;        // the first one
  bool alone = true;   // there is no other
  bool inside = true;  // and neither image border nor other region beside it
};

std::vector<Touch> touches(const LabelMap& pieces, const cv::Mat& seeds, const cv::Mat& regions) {
  std::vector<Touch> result(static_cast<std::size_t>(pieces.count) + 1);
  for (int y = 0; y < seeds.rows; ++y) {
    for (int x = 0; x < seeds.cols; ++x) {
      const int piece = pieces.labels.at<int>(y, x);
      if (!piece) continue;
      Touch& touch = result[piece];
      if (x == 0 || y == 0 || x + 1 == seeds.cols || y + 1 == seeds.rows) touch.inside = false;
      for_neighbours(seeds.size(), y, x, [&](int v, int u) {
        if (regions.at<int>(v, u) != regions.at<int>(y, x)) touch.inside = false;
        const int seed = regions.at<int>(v, u) == regions.at<int>(y, x) ? seeds.at<int>(v, u) : 0;
        if (!seed) return;
        if (touch.seed && touch.seed != seed) touch.alone = false;
        if (!touch.seed) touch.seed = seed;
      });
    }
  }
  return result;
}

void join(const LabelMap& pieces, const std::vector<Touch>& touched, bool only_inside, cv::Mat& seeds) {
  for (int y = 0; y < seeds.rows; ++y) {
    for (int x = 0; x < seeds.cols; ++x) {
      const int piece = pieces.labels.at<int>(y, x);
      if (!piece) continue;
      const Touch& touch = touched[piece];
      if (touch.seed && touch.alone && (touch.inside || !only_inside)) seeds.at<int>(y, x) = touch.seed;
    }
  }
}

// `regions` where there is no seed yet.
cv::Mat remaining(const cv::Mat& seeds, const cv::Mat& regions) {
  cv::Mat rest = regions.clone();
  rest.setTo(0, seeds != 0);
  return rest;
}

void fill_holes(const cv::Mat& regions, cv::Mat& seeds) {
  const LabelMap pieces = connected_pieces(remaining(seeds, regions));
  join(pieces, touches(pieces, seeds, regions), true, seeds);
}

void join_low_pieces(const cv::Mat& j, const cv::Mat& regions, cv::Mat& seeds) {
  const cv::Mat rest = remaining(seeds, regions);
  std::vector<double> means;
  for (const Statistics& each : statistics(j, rest)) means.push_back(each.mean());
  const LabelMap pieces = connected_pieces(low_pixels(j, rest, means, false));
  join(pieces, touches(pieces, seeds, regions), false, seeds);
}

// Pixel by pixel, lowest J first; among equals the one that was reached first.
void flood(const cv::Mat& j, const cv::Mat& regions, cv::Mat& seeds) {
  using Entry = std::tuple<float, int, int, int>;  // J, order, pixel, seed
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  int order = 0;
  const auto reach_from = [&](int y, int x) {
    for_neighbours(seeds.size(), y, x, [&](int v, int u) {
      if (!seeds.at<int>(v, u) && regions.at<int>(v, u) == regions.at<int>(y, x))
        queue.emplace(j.at<float>(v, u), order++, v * seeds.cols + u, seeds.at<int>(y, x));
    });
  };
  for (int y = 0; y < seeds.rows; ++y)
    for (int x = 0; x < seeds.cols; ++x)
      if (seeds.at<int>(y, x)) reach_from(y, x);
  while (!queue.empty()) {
    const auto [value, when, pixel, seed] = queue.top();
    queue.pop();
    const int y = pixel / seeds.cols, x = pixel % seeds.cols;
    if (seeds.at<int>(y, x)) continue;
    seeds.at<int>(y, x) = seed;
    reach_from(y, x);
  }
}

}  // namespace

LabelMap connected_pieces(const cv::Mat& keys, int least_px) {
  const int columns = keys.cols;
  DisjointSets sets(keys.total());
  for (int y = 0; y < keys.rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int key = keys.at<int>(y, x);
      if (!key) continue;
      if (x > 0 && keys.at<int>(y, x - 1) == key) sets.join(y * columns + x - 1, y * columns + x);
      if (y > 0 && keys.at<int>(y - 1, x) == key) sets.join((y - 1) * columns + x, y * columns + x);
    }
  }
  std::vector<int> of(keys.total(), 0);  // of the roots: pixels, then the label
  for (int i = 0; i < static_cast<int>(of.size()); ++i)
    if (keys.at<int>(i / columns, i % columns)) ++of[sets.root(i)];
  LabelMap pieces{cv::Mat::zeros(keys.size(), CV_32S), 0};
  for (int i = 0; i < static_cast<int>(of.size()); ++i) {  // a root comes before the rest of its piece
    if (!keys.at<int>(i / columns, i % columns)) continue;
    const int root = sets.root(i);
    if (root == i) of[i] = of[i] >= least_px ? ++pieces.count : 0;
    pieces.labels.at<int>(i / columns, i % columns) = of[root];
  }
  return pieces;
}

int least_region_px(int scale) {
  const int side = 32 << scale;  // 64, 128, 256, 512
  return side * side;
}

int least_valley_px(int scale) { return 32 << (2 * (scale - 1)); }  // 32, 128, 512, 2048

LabelMap valleys(const cv::Mat& j, const cv::Mat& regions, int scale) {
  const auto of = statistics(j, regions);
  std::vector<int> most(of.size(), 0);
  std::vector<LabelMap> best(of.size());  // by region; maps are shared
  for (const double off : kThresholds) {
    std::vector<double> thresholds;
    for (const Statistics& each : of) thresholds.push_back(each.mean() + off * each.deviation());
    const LabelMap found = connected_pieces(low_pixels(j, regions, thresholds, true), least_valley_px(scale));
    std::vector<char> seen(static_cast<std::size_t>(found.count) + 1, 0);
    std::vector<int> counts(of.size(), 0);
    for (int y = 0; y < j.rows; ++y)
      for (int x = 0; x < j.cols; ++x)
        if (const int label = found.labels.at<int>(y, x); label && !seen[label])
          seen[label] = 1, ++counts[regions.at<int>(y, x)];
    for (std::size_t r = 1; r < of.size(); ++r)
      if (counts[r] > most[r]) most[r] = counts[r], best[r] = found;
  }
  cv::Mat keys = cv::Mat::zeros(j.size(), CV_32S);  // valleys of a region do not touch one another
  for (int y = 0; y < j.rows; ++y)
    for (int x = 0; x < j.cols; ++x)
      if (const int r = regions.at<int>(y, x); r && most[r] > 0 && best[r].labels.at<int>(y, x)) keys.at<int>(y, x) = r;
  return connected_pieces(keys);
}

LabelMap grown(const LabelMap& seeds, const cv::Mat& regions, const std::vector<cv::Mat>& j, int scale) {
  LabelMap result{seeds.labels.clone(), seeds.count};
  fill_holes(regions, result.labels);
  for (int s = scale; s >= 1; --s) join_low_pieces(j[s - 1], regions, result.labels);
  flood(j[0], regions, result.labels);
  const LabelMap without_seed = connected_pieces(remaining(result.labels, regions));
  cv::Mat rest = without_seed.labels + result.count;
  rest.copyTo(result.labels, without_seed.labels != 0);
  result.count += without_seed.count;
  return result;
}

}  // namespace dressform
