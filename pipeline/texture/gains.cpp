#include "pipeline/texture/gains.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "scenes/srgb.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr float kDarkest = 8, kBrightest = 247;  // levels outside say little of the ratio
constexpr float kSeen = 0.5f;                    // trust from which a view's colour is compared
constexpr double kPull = 1e-6;                   // of a view's gain towards none, over one ratio

float level_of(float linear) { return 255.f * srgb_of_linear(linear); }

}  // namespace

void Overlaps::add(const std::vector<ColorView>& views, const VertexSamples& samples, const GainParams& params) {
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      auto& ratios = log_ratios_[{views[i].sensor, views[j].sensor}];
      for (Eigen::Index v = 0; v < samples.trust.rows(); ++v) {
        if (std::min(samples.trust(v, i), samples.trust(v, j)) < kSeen) continue;
        if (std::min(samples.facing(v, i), samples.facing(v, j)) < params.least_facing) continue;
        for (int c = 0; c < 3; ++c) {
          const float a = samples.low[i](v, c), b = samples.low[j](v, c);
          if (is_usable_level(a) && is_usable_level(b))
            ratios[c].push_back(std::log(linear_of_level(a)) - std::log(linear_of_level(b)));
        }
      }
    }
}

std::map<std::string, cv::Vec3f> Overlaps::gains(const GainParams& params) const {
  std::map<std::string, int> index;
  for (const auto& [pair, ratios] : log_ratios_) index[pair.first] = index[pair.second] = 0;
  int next = 0;
  for (auto& [sensor, i] : index) i = next++;
  std::map<std::string, cv::Vec3f> gains;
  for (const auto& [sensor, i] : index) gains[sensor] = cv::Vec3f(1, 1, 1);
  for (int c = 0; c < 3 && next > 0; ++c) {
    // Weak pull to no gain: settles the mean, and whoever overlaps nobody.
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(next, next) * kPull;
    Eigen::VectorXd b = Eigen::VectorXd::Zero(next);
    for (const auto& [pair, ratios] : log_ratios_) {
      if (static_cast<int>(ratios[c].size()) < std::max(1, params.least_vertices)) continue;
      const int i = index.at(pair.first), j = index.at(pair.second);
      const double weight = std::sqrt(static_cast<double>(ratios[c].size())), middle = median(ratios[c]);
      a(i, i) += weight;
      a(j, j) += weight;
      a(i, j) -= weight;
      a(j, i) -= weight;
      b(i) -= weight * middle;
      b(j) += weight * middle;
    }
    Eigen::VectorXd log_gain = a.fullPivLu().solve(b);
    for (const auto& [sensor, i] : index) gains[sensor][c] = static_cast<float>(std::exp(log_gain[i]));
  }
  return gains;
}

bool is_usable_level(float level) { return level >= kDarkest && level <= kBrightest; }

float linear_of_level(float level) { return linear_of_srgb(level / 255.f); }

float with_gain(float level, float gain) { return gain == 1.f ? level : level_of(gain * linear_of_level(level)); }

void apply_gain(ColorView& view, const cv::Vec3f& gain) {
  if (gain == cv::Vec3f(1, 1, 1)) return;
  for (cv::Mat* band : {&view.color, &view.low}) {
    *band = band->clone();
    band->forEach<cv::Vec3f>([&](cv::Vec3f& pixel, const int*) {
      for (int c = 0; c < 3; ++c) pixel[c] = with_gain(pixel[c], gain[c]);
    });
  }
}

}  // namespace dressform
