#include "pipeline/segment/jseg_merging.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <queue>
#include <set>
#include <tuple>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

struct Region {
  std::vector<double> counts;  // by class
  double pixels = 0;
  std::set<int> beside;
  int version = 0;  // goes up with each merge; -1: gone
};

std::vector<Region> described(const LabelMap& map, const cv::Mat& classes, int class_count) {
  std::vector<Region> regions(static_cast<std::size_t>(map.count) + 1);
  for (Region& region : regions) region.counts.assign(static_cast<std::size_t>(class_count), 0);
  const auto touch = [&](int a, int b) {
    if (a && b && a != b) regions[a].beside.insert(b), regions[b].beside.insert(a);
  };
  for (int y = 0; y < map.labels.rows; ++y) {
    for (int x = 0; x < map.labels.cols; ++x) {
      const int label = map.labels.at<int>(y, x);
      if (!label) continue;
      regions[label].counts[classes.at<int>(y, x)] += 1;
      regions[label].pixels += 1;
      if (x > 0) touch(label, map.labels.at<int>(y, x - 1));
      if (y > 0) touch(label, map.labels.at<int>(y - 1, x));
    }
  }
  return regions;
}

double histogram_distance(const Region& a, const Region& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.counts.size(); ++k) {
    const double d = a.counts[k] / a.pixels - b.counts[k] / b.pixels;
    sum += d * d;
  }
  return std::sqrt(sum);
}

class Merging {
 public:
  Merging(std::vector<Region> regions, double limit)
      : regions_(std::move(regions)), sets_(regions_.size()), limit_(limit) {
    for (int a = 1; a < static_cast<int>(regions_.size()); ++a)
      for (const int b : regions_[a].beside)
        if (a < b) offer(a, b);
  }

  // The sets of regions that became one.
  DisjointSets run() {
    while (!queue_.empty()) {
      const auto [distance, a, b, version_a, version_b] = queue_.top();
      queue_.pop();
      if (regions_[a].version == version_a && regions_[b].version == version_b) unite(a, b);
    }
    return sets_;
  }

 private:
  void offer(int a, int b) {
    const double distance = histogram_distance(regions_[a], regions_[b]);
    if (distance < limit_)
      queue_.emplace(distance, std::min(a, b), std::max(a, b), regions_[std::min(a, b)].version,
                     regions_[std::max(a, b)].version);
  }

  // b goes into a, which is the smaller label.
  void unite(int a, int b) {
    Region &into = regions_[a], &from = regions_[b];
    sets_.join(a, b);
    for (std::size_t k = 0; k < into.counts.size(); ++k) into.counts[k] += from.counts[k];
    into.pixels += from.pixels;
    for (const int other : from.beside) {
      regions_[other].beside.erase(b);
      if (other != a) regions_[other].beside.insert(a), into.beside.insert(other);
    }
    from.version = -1;
    ++into.version;
    for (const int other : into.beside) offer(a, other);
  }

  using Entry = std::tuple<double, int, int, int, int>;  // distance, labels, versions
  std::vector<Region> regions_;
  DisjointSets sets_;
  double limit_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

LabelMap merged(const LabelMap& regions, const cv::Mat& classes, int class_count, double distance) {
  DisjointSets sets = Merging(described(regions, classes, class_count), distance).run();
  LabelMap result{cv::Mat::zeros(regions.labels.size(), CV_32S), 0};
  std::vector<int> label_of(static_cast<std::size_t>(regions.count) + 1, 0);
  for (int y = 0; y < regions.labels.rows; ++y) {
    for (int x = 0; x < regions.labels.cols; ++x) {
      const int before = regions.labels.at<int>(y, x);
      if (!before) continue;
      int& label = label_of[sets.root(before)];
      if (!label) label = ++result.count;
      result.labels.at<int>(y, x) = label;
    }
  }
  return result;
}

}  // namespace dressform
