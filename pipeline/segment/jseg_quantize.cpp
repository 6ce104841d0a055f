#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>

#include "pipeline/segment/jseg_colors.h"

namespace dressform {
namespace {

constexpr float kCell = 2;                              // L*u*v* units: colours nearer than this are counted together
constexpr int kFewestAtFirst = 17, kMostAtFirst = 256;  // classes, before any are merged
constexpr double kClassesPerRadius = 2;                 // at first, for one unit of the mean peer radius
constexpr double kSplitTolerance = 0.05, kFinalTolerance = 0.03;  // of the distortion, between rounds
constexpr int kRounds = 5;
constexpr int kMostDoublings = 12;  // eight make 256 classes; the rest replaces clusters that came out empty
constexpr double kAutomatic = 260, kAutomaticMost = 400;  // squared L*u*v* distances
// So few classes are kept as long as they can be told apart: an image of little contrast has regions, too.
constexpr int kFewestClasses = 3;
constexpr double kToldApart = 25;  // squared L*u*v* distance

// Pixels of nearly one colour.
struct Cell {
  cv::Vec3d color;  // weighted mean
  double weight;
};

struct Cells {
  std::vector<Cell> cells;
  cv::Mat index;  // int32, image size; -1 outside the mask
};

// Cells in the order of their colours.
Cells counted(const PeerGroups& image, const cv::Mat& mask) {
  Cells result{{}, cv::Mat(mask.size(), CV_32S, cv::Scalar(-1))};
  std::vector<std::pair<std::uint64_t, int>> order;
  const auto part = [](float value) { return static_cast<std::uint64_t>(std::floor(value / kCell) + 512) & 1023; };
  for (int y = 0, i = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x, ++i) {
      if (!mask.at<uchar>(y, x)) continue;
      const auto& c = image.luv.at<cv::Vec3f>(y, x);
      order.emplace_back(part(c[0]) << 20 | part(c[1]) << 10 | part(c[2]), i);
    }
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) result.cells.push_back({{0, 0, 0}, 0});
    Cell& cell = result.cells.back();
    const int y = order[i].second / mask.cols, x = order[i].second % mask.cols;
    const double weight = std::exp(-static_cast<double>(image.radius.at<float>(y, x)));
    cell.color += weight * cv::Vec3d(image.luv.at<cv::Vec3f>(y, x));
    cell.weight += weight;
    result.index.at<int>(y, x) = static_cast<int>(result.cells.size()) - 1;
  }
  for (Cell& cell : result.cells) cell.color *= 1 / cell.weight;
  return result;
}

double squared(const cv::Vec3d& d) { return d.dot(d); }

// A class while the algorithm runs.
struct Cluster {
  cv::Vec3d center{0, 0, 0};
  double weight = 0, distortion = 0;  // sum of weighted squared distances
};

class Clustering {
 public:
  explicit Clustering(const std::vector<Cell>& cells) : cells_(cells), of_(cells.size(), 0), clusters_(1) { update(); }

  const std::vector<Cluster>& clusters() const { return clusters_; }
  const std::vector<int>& of() const { return of_; }

  // Generalised Lloyd algorithm: until the distortion falls by less than `tolerance`, or kRounds are over.
  void settle(double tolerance) {
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
      assign();
      update();
      double now = 0;
      for (const Cluster& cluster : clusters_) now += cluster.distortion;
      if (before - now <= tolerance * now) return;
      before = now;
    }
  }

  // The clusters of the largest distortion are parted along the axis in which they are longest.
  void split(int most_new) {
    std::vector<int> order(clusters_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return clusters_[a].distortion > clusters_[b].distortion; });
    const auto axes = long_axes();
    for (int i = 0; i < static_cast<int>(order.size()) && i < most_new; ++i) {
      if (!(clusters_[order[i]].distortion > 0)) break;
      Cluster other = clusters_[order[i]];
      other.center += axes[order[i]];
      clusters_[order[i]].center -= axes[order[i]];
      clusters_.push_back(other);
    }
  }

  void merge(int a, int b) {
    Cluster &into = clusters_[a], &from = clusters_[b];
    const double weight = into.weight + from.weight;
    into.center = (into.center * into.weight + from.center * from.weight) * (1 / weight);
    into.weight = weight;
    clusters_.erase(clusters_.begin() + b);
  }

 private:
  void assign() {
    tbb::parallel_for(std::size_t{0}, (cells_.size() + 1023) / 1024, [&](std::size_t block) {
      const std::size_t end = std::min(cells_.size(), (block + 1) * 1024);
      for (std::size_t i = block * 1024; i < end; ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < clusters_.size(); ++k)
          if (const double d = squared(cells_[i].color - clusters_[k].center); d < least)
            least = d, of_[i] = static_cast<int>(k);
      }
    });
  }

  // Centres from members; clusters without members go.
  void update() {
    std::vector<Cluster> next(clusters_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      next[of_[i]].center += cells_[i].weight * cells_[i].color;
      next[of_[i]].weight += cells_[i].weight;
    }
    std::vector<int> moved(next.size(), -1);
    clusters_.clear();
    for (std::size_t k = 0; k < next.size(); ++k) {
      if (!(next[k].weight > 0)) continue;
      next[k].center *= 1 / next[k].weight;
      moved[k] = static_cast<int>(clusters_.size());
      clusters_.push_back(next[k]);
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      of_[i] = moved[of_[i]];
      Cluster& cluster = clusters_[of_[i]];
      cluster.distortion += cells_[i].weight * squared(cells_[i].color - cluster.center);
    }
  }

  // One standard deviation along the longest axis of each cluster.
  std::vector<cv::Vec3d> long_axes() const {
    std::vector<cv::Matx33d> spread(clusters_.size(), cv::Matx33d::zeros());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const cv::Vec3d d = cells_[i].color - clusters_[of_[i]].center;
      spread[of_[i]] += cells_[i].weight * (d * d.t());
    }
    std::vector<cv::Vec3d> axes;
    for (std::size_t k = 0; k < clusters_.size(); ++k) {
      cv::Vec3d values;
      cv::Matx33d vectors;
      cv::eigen(spread[k] * (1 / clusters_[k].weight), values, vectors);
      const double length = std::sqrt(std::max(0.0, values[0]));
      axes.emplace_back(vectors(0, 0) * length, vectors(0, 1) * length, vectors(0, 2) * length);
    }
    return axes;
  }

  const std::vector<Cell>& cells_;
  std::vector<int> of_;  // cluster of each cell
  std::vector<Cluster> clusters_;
};

int classes_at_first(const PeerGroups& image, const cv::Mat& mask) {
  const double mean = cv::mean(image.radius, mask)[0];
  return std::clamp(static_cast<int>(std::lround(kClassesPerRadius * mean)), kFewestAtFirst, kMostAtFirst);
}

struct NearestPair {
  int a = -1, b = -1;
  double squared_distance = std::numeric_limits<double>::infinity();
};

NearestPair nearest_pair(const std::vector<Cluster>& clusters) {
  NearestPair nearest;
  for (int a = 0; a < static_cast<int>(clusters.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(clusters.size()); ++b)
      if (const double d = squared(clusters[a].center - clusters[b].center); d < nearest.squared_distance)
        nearest = {a, b, d};
  return nearest;
}

// The squared distance to merge up to: before the merge between kAutomatic and kAutomaticMost with which the colours'
// own J = (S_T - S_W) / S_W falls most.
double automatic_threshold(Clustering clustering) {
  double within = 0, weight = 0, total = 0;
  cv::Vec3d mean(0, 0, 0);
  for (const Cluster& c : clustering.clusters())
    within += c.distortion, weight += c.weight, mean += c.weight * c.center;
  mean *= 1 / weight;
  for (const Cluster& c : clustering.clusters()) total += c.weight * squared(c.center - mean);
  total += within;
  double threshold = kAutomatic, largest = 0;
  for (;;) {
    const NearestPair next = nearest_pair(clustering.clusters());
    if (!(next.squared_distance < kAutomaticMost)) return threshold;
    const double wa = clustering.clusters()[next.a].weight, wb = clustering.clusters()[next.b].weight;
    const double after = within + wa * wb / (wa + wb) * next.squared_distance;
    const double drop = within > 0 ? total / within - total / after : std::numeric_limits<double>::infinity();
    if (next.squared_distance >= kAutomatic && drop > largest) largest = drop, threshold = next.squared_distance;
    within = after;
    clustering.merge(next.a, next.b);
  }
}

void merge_near(Clustering& clustering, const QuantizeParams& params) {
  const bool automatic = params.classes == 0 && params.threshold == 0;
  const double limit = automatic            ? automatic_threshold(clustering)
                       : params.classes > 0 ? std::numeric_limits<double>::infinity()
                                            : params.threshold;
  while (static_cast<int>(clustering.clusters().size()) > std::max(1, params.classes)) {
    const NearestPair next = nearest_pair(clustering.clusters());
    if (!(next.squared_distance < limit)) return;
    if (automatic && static_cast<int>(clustering.clusters().size()) <= kFewestClasses &&
        next.squared_distance >= kToldApart)
      return;
    clustering.merge(next.a, next.b);
  }
}

}  // namespace

ColorClasses quantized(const PeerGroups& image, const cv::Mat& mask, const QuantizeParams& params) {
  const Cells colors = counted(image, mask);
  ColorClasses result{cv::Mat(mask.size(), CV_32S, cv::Scalar(-1)), {}};
  if (colors.cells.empty()) return result;
  const int at_first = std::max(params.classes, classes_at_first(image, mask));
  Clustering clustering(colors.cells);
  for (int doubling = 0; doubling < kMostDoublings; ++doubling) {
    const int missing = at_first - static_cast<int>(clustering.clusters().size());
    if (missing <= 0) break;
    clustering.split(missing);
    clustering.settle(kSplitTolerance);
  }
  merge_near(clustering, params);
  clustering.settle(kFinalTolerance);
  for (const Cluster& cluster : clustering.clusters()) result.luv.emplace_back(cluster.center);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (const int cell = colors.index.at<int>(y, x); cell >= 0) result.classes.at<int>(y, x) = clustering.of()[cell];
  return result;
}

}  // namespace dressform
