#include "pipeline/open/rim_fit.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pipeline/open/rim_path.h"
#include "scenes/random.h"
#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

const std::uint64_t kStream = stream_of("flat cut");
constexpr double kOffPath = 2.5;  // scales that samples may lie off the best path
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

Eigen::VectorXd solve(const std::vector<RimSample>& samples, const Eigen::VectorXd& weights, double smoothness,
                      double flatness, const RimCurve& base, int count) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  // A knot's samples weigh one together, so that the smoothness means the same for any density; few less, as they may
  // all be strays. Those that have lost their robust weight count in the sum: where samples lie all along the limb,
  // none is to be believed.
  std::vector<double> per_knot(count, 0);
  for (const RimSample& s : samples) per_knot[place(s.angle, count).knot] += s.weight;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Place p = place(samples[i].angle, count);
    const int a = p.knot, b = (p.knot + 1) % count;
    const double w = weights[i] / std::max(kFullRimKnot, per_knot[a]);
    const double wa = 1 - p.part, wb = p.part;
    normal(a, a) += w * wa * wa;
    normal(a, b) += w * wa * wb;
    normal(b, a) += w * wa * wb;
    normal(b, b) += w * wb * wb;
    const double off = samples[i].along - base.at(samples[i].angle);
    right[a] += w * wa * off;
    right[b] += w * wb * off;
  }
  for (int i = 0; i < count; ++i) {
    normal(i, i) += flatness;
    const int at[3] = {i, (i + 1) % count, (i + 2) % count};
    const double second[3] = {1, -2, 1}, first[3] = {1, -1, 0};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        normal(at[r], at[c]) += smoothness * (second[r] * second[c] + kTension * first[r] * first[c]);
  }
  return solve_symmetric(normal, right);
}

constexpr int kCoverParts = 36;  // of the turn, each seen or not
constexpr int kUnseenParts = 3;  // one after the other without samples: a stretch that no view saw
constexpr int kParts = 24;       // of the turn, one vote each
constexpr int kTrials = 600;
constexpr double kMostTilt_m = 0.08;
constexpr double kTiltPrice = 40;  // votes per metre of tilt: small against a vote unless little is seen

double votes(const std::vector<std::vector<RimSample>>& parts, const FlatCut& cut, double scale) {
  double sum = -kTiltPrice * std::hypot(cut.tilt_cos, cut.tilt_sin);
  for (const auto& part : parts) {
    double most = 0, total = 0;
    for (const RimSample& s : part) {
      const double w = s.weight * tukey_weight(s.along - cut.at(s.angle), scale / 2);
      most = std::max(most, w);
      total += w;
    }
    sum += std::min(1.0, total) * (most > 0 ? 1 : 0);
  }
  return sum;
}

// Through three samples; absent where they lie too close together or the cut would be steep.
std::optional<FlatCut> through(const RimSample& a, const RimSample& b, const RimSample& c) {
  Eigen::Matrix3d m;
  Eigen::Vector3d right(a.along, b.along, c.along);
  int row = 0;
  for (const RimSample* s : {&a, &b, &c}) m.row(row++) << 1, std::cos(s->angle), std::sin(s->angle);
  if (std::abs(m.determinant()) < 0.2) return {};
  const Eigen::Vector3d x = m.inverse() * right;
  const FlatCut cut{x[0], x[1], x[2]};
  if (!(std::hypot(cut.tilt_cos, cut.tilt_sin) <= kMostTilt_m)) return {};
  return cut;
}

// Least squares over the samples near the cut, each part of the turn counting once, with a small price on tilt.
FlatCut refined(const std::vector<std::vector<RimSample>>& parts, const FlatCut& cut, double scale) {
  Eigen::Matrix3d normal = Eigen::Vector3d(1e-9, 0.02, 0.02).asDiagonal();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& part : parts) {
    double total = 0;
    for (const RimSample& s : part) total += s.weight * tukey_weight(s.along - cut.at(s.angle), scale);
    if (total <= 1e-9) continue;
    for (const RimSample& s : part) {
      const double w = s.weight * tukey_weight(s.along - cut.at(s.angle), scale) / std::max(1.0, total);
      const Eigen::Vector3d row(1, std::cos(s.angle), std::sin(s.angle));
      normal += w * row * row.transpose();
      right += w * s.along * row;
    }
  }
  const Eigen::Vector3d x = solve_symmetric(normal, right);
  return {x[0], x[1], x[2]};
}

}  // namespace

double rim_knot_angle(int knot, int count) { return -M_PI + 2 * M_PI * knot / count; }

double tukey_weight(double residual, double scale) {
  constexpr double kConstant = 4.685;  // of the noise's sigma: 95 % efficient where all noise is normal
  return Tukey(residual / (kConstant * scale)).weight;
}

double FlatCut::at(double angle) const { return middle + tilt_cos * std::cos(angle) + tilt_sin * std::sin(angle); }

FlatCut fit_flat_cut(const std::vector<RimSample>& samples, double scale_m) {
  if (samples.empty()) return {};
  std::vector<std::vector<RimSample>> parts(kParts);
  for (const RimSample& s : samples) parts[place(s.angle, kParts).knot].push_back(s);
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); }), parts.end());
  FlatCut best;
  double most = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const FlatCut& cut) {
    const double score = votes(parts, cut, scale_m);
    if (score <= most) return;
    most = score;
    best = cut;
  };
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / kTrials);
  for (std::size_t i = 0; i < samples.size(); i += stride) consider({samples[i].along, 0, 0});
  for (int trial = 0; trial < kTrials && parts.size() >= 3; ++trial) {
    const RimSample* picked[3];
    for (int k = 0; k < 3; ++k) {
      const auto& part = parts[static_cast<std::size_t>(uniform(0, kStream, 6 * trial + 2 * k) * parts.size())];
      picked[k] = &part[static_cast<std::size_t>(uniform(0, kStream, 6 * trial + 2 * k + 1) * part.size())];
    }
    if (const auto cut = through(*picked[0], *picked[1], *picked[2])) consider(*cut);
  }
  for (int round = 0; round < 5; ++round) best = refined(parts, best, scale_m);
  return best;
}

double RimCurve::at(double angle) const {
  if (knots.empty()) return 0;
  const int count = static_cast<int>(knots.size());
  const Place p = place(angle, count);
  const auto value = [&](int i) { return knots[(i + count) % count]; };
  // Catmull-Rom between the knots.
  const double a = value(p.knot - 1), b = value(p.knot), c = value(p.knot + 1), d = value(p.knot + 2), t = p.part;
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

bool RimCurve::unseen(double angle) const {
  const int count = static_cast<int>(covered.size());
  if (!count) return true;
  const int at = place(angle, count).knot;
  int run = 0;
  for (const int way : {1, -1})
    for (int step = way == 1 ? 0 : 1; step < count && !covered[((at + way * step) % count + count) % count]; ++step)
      ++run;
  return run >= kUnseenParts;
}

RimCurve fit_rim(const std::vector<RimSample>& samples, const RimFitParams& params) {
  RimCurve curve;
  if (samples.empty()) return curve;
  const int count = params.knots;
  const FlatCut flat = fit_flat_cut(samples, 2 * params.scale_m);
  RimCurve path;
  path.knots = best_rim_path(samples, flat, {params.scale_m, params.bend_price});
  for (int i = 0; i < count; ++i) curve.knots.push_back(path.at(rim_knot_angle(i, count)));
  Eigen::VectorXd weights(samples.size());
  for (int round = 0; round < params.rounds; ++round) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const RimSample& s = samples[i];
      const bool near = std::abs(s.along - path.at(s.angle)) < kOffPath * params.scale_m;  // no creeping towards strays
      weights[i] = near ? s.weight * tukey_weight(s.along - curve.at(s.angle), params.scale_m) : 0;
    }
    const Eigen::VectorXd off = solve(samples, weights, params.smoothness, params.flatness, path, count);
    for (int i = 0; i < count; ++i) curve.knots[i] = path.at(rim_knot_angle(i, count)) + off[i];
  }
  curve.covered.assign(kCoverParts, 0);
  double squares = 0;
  for (const RimSample& s : samples) {
    const double residual = s.along - curve.at(s.angle);
    if (std::abs(residual) > 4 * params.scale_m) continue;
    ++curve.inliers;
    squares += residual * residual;
    curve.covered[place(s.angle, kCoverParts).knot] = 1;
  }
  curve.coverage = std::count(curve.covered.begin(), curve.covered.end(), 1) / static_cast<double>(kCoverParts);
  if (curve.inliers) curve.residual_rms_m = std::sqrt(squares / curve.inliers);
  return curve;
}

}  // namespace dressform
