#include "pipeline/open/rim_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kTension = 1.0;  // of first differences: angles without samples are bridged without swinging out

struct Place {
  int knot;     // and the next one
  double part;  // of the way to the next
};

Place place(double angle, int count) {
  double at = (angle + M_PI) / (2 * M_PI) * count;
  at -= count * std::floor(at / count);
  const int knot = std::min(static_cast<int>(at), count - 1);
  return {knot, at - knot};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Median of each sector of 30 degrees, and then of these: a large sector full of samples counts once.
double typical(const std::vector<RimSample>& samples) {
  std::vector<std::vector<double>> sectors(12);
  for (const RimSample& s : samples) sectors[place(s.angle, 12).knot].push_back(s.along);
  std::vector<double> medians;
  for (const auto& sector : sectors)
    if (!sector.empty()) medians.push_back(median(sector));
  return median(medians);
}

double tukey(double residual, double scale) {
  const double u = residual / (4.685 * scale);
  return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
}

Eigen::VectorXd solve(const std::vector<RimSample>& samples, const Eigen::VectorXd& weights, double smoothness,
                      int count) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  // Weights are brought to a mean of one per covered knot, so that the smoothness means the same for any density.
  std::vector<double> per_knot(count, 0);
  for (std::size_t i = 0; i < samples.size(); ++i) per_knot[place(samples[i].angle, count).knot] += weights[i];
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Place p = place(samples[i].angle, count);
    const int a = p.knot, b = (p.knot + 1) % count;
    const double w = weights[i] * std::min(1.0, per_knot[a]) / std::max(per_knot[a], 1e-12);
    const double wa = 1 - p.part, wb = p.part;
    normal(a, a) += w * wa * wa;
    normal(a, b) += w * wa * wb;
    normal(b, a) += w * wa * wb;
    normal(b, b) += w * wb * wb;
    right[a] += w * wa * samples[i].along;
    right[b] += w * wb * samples[i].along;
  }
  for (int i = 0; i < count; ++i) {
    const int at[3] = {i, (i + 1) % count, (i + 2) % count};
    const double second[3] = {1, -2, 1}, first[3] = {1, -1, 0};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        normal(at[r], at[c]) += smoothness * (second[r] * second[c] + kTension * first[r] * first[c]);
  }
  return normal.ldlt().solve(right);
}

}  // namespace

double RimCurve::at(double angle) const {
  if (knots.empty()) return 0;
  const int count = static_cast<int>(knots.size());
  const Place p = place(angle, count);
  const auto value = [&](int i) { return knots[(i + count) % count]; };
  // Catmull-Rom between the knots.
  const double a = value(p.knot - 1), b = value(p.knot), c = value(p.knot + 1), d = value(p.knot + 2), t = p.part;
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

RimCurve fit_rim(const std::vector<RimSample>& samples, const RimFitParams& params) {
  RimCurve curve;
  if (samples.empty()) return curve;
  const int count = params.knots;
  curve.knots.assign(count, typical(samples));
  Eigen::VectorXd weights(samples.size());
  for (int round = 0; round < params.rounds; ++round) {
    const double part = params.rounds > 1 ? static_cast<double>(round) / (params.rounds - 1) : 1;
    const double scale = params.first_scale_m * std::pow(params.last_scale_m / params.first_scale_m, part);
    for (std::size_t i = 0; i < samples.size(); ++i)
      weights[i] = samples[i].weight * tukey(samples[i].along - curve.at(samples[i].angle), scale);
    if (weights.sum() < 1e-9) break;
    const double smoothness = params.first_smoothness * std::pow(params.smoothness / params.first_smoothness, part);
    const Eigen::VectorXd solution = solve(samples, weights, smoothness, count);
    curve.knots.assign(solution.data(), solution.data() + count);
  }
  std::vector<char> covered(36, 0);
  double squares = 0;
  for (const RimSample& s : samples) {
    const double residual = s.along - curve.at(s.angle);
    if (std::abs(residual) > 2 * params.last_scale_m) continue;
    ++curve.inliers;
    squares += residual * residual;
    covered[place(s.angle, 36).knot] = 1;
  }
  curve.coverage = std::count(covered.begin(), covered.end(), 1) / 36.0;
  if (curve.inliers) curve.residual_rms_m = std::sqrt(squares / curve.inliers);
  return curve;
}

}  // namespace dressform
