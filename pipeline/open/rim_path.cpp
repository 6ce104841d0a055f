#include "pipeline/open/rim_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/imaging/distance_transform.h"

namespace dressform {
namespace {

constexpr double kBin_m = 0.002;
constexpr double kReach_m = 0.2;  // furthest from the flat cut
constexpr int kSteepest = 13;     // bins from one knot to the next
constexpr int kSlopes = 2 * kSteepest + 1;

int nearest_knot(double angle) {
  const int knot = static_cast<int>(std::lround((angle + M_PI) / (2 * M_PI) * kRimPathKnots));
  return ((knot % kRimPathKnots) + kRimPathKnots) % kRimPathKnots;
}

// Heights off the flat cut, in bins; knots round the opening.
class PathGrid {
 public:
  PathGrid(const std::vector<RimSample>& samples, const FlatCut& flat, const RimPathParams& params)
      : params_(params), reach_(static_cast<int>(std::ceil(kReach_m / kBin_m))), bins_(2 * reach_ + 1) {
    price_.assign(static_cast<std::size_t>(kRimPathKnots) * bins_, 0);
    weigh(samples, flat);
  }

  // The path's bins of the middle one of three turns, which feels its neighbours on both sides.
  std::vector<int> best() {
    constexpr int kTurns = 3;
    std::vector<double> cost(states(), 0), next(states());
    for (int bin = 0; bin < bins_; ++bin)
      for (int slope = 0; slope < kSlopes; ++slope) cost[state(bin, slope)] = price_[bin];
    std::vector<std::vector<unsigned char>> from;  // the slope that led to a state
    for (int step = 1; step < kTurns * kRimPathKnots; ++step) {
      from.emplace_back(states());
      advance(cost, next, from.back(), &price_[static_cast<std::size_t>(step % kRimPathKnots) * bins_]);
      cost.swap(next);
    }
    int at = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    std::vector<int> path(kRimPathKnots, 0);
    for (int step = kTurns * kRimPathKnots - 1; step >= kRimPathKnots; --step) {
      const int bin = at / kSlopes, slope = at % kSlopes;
      if (step < 2 * kRimPathKnots) path[step - kRimPathKnots] = bin - reach_;
      at = state(bin - (slope - kSteepest), from[step - 1][at]);
    }
    return path;
  }

 private:
  std::size_t states() const { return static_cast<std::size_t>(bins_) * kSlopes; }
  static int state(int bin, int slope) { return bin * kSlopes + slope; }

  // A knot's samples are worth one together; few of them less.
  void weigh(const std::vector<RimSample>& samples, const FlatCut& flat) {
    std::vector<double> total(kRimPathKnots, 0);
    for (const RimSample& s : samples) total[nearest_knot(s.angle)] += s.weight;
    for (const RimSample& s : samples) {
      const int knot = nearest_knot(s.angle);
      const double off = s.along - flat.at(s.angle), worth = s.weight / std::max(kFullRimKnot, total[knot]);
      for (int bin = 0; bin < bins_; ++bin)
        price_[static_cast<std::size_t>(knot) * bins_ + bin] -=
            worth * tukey_weight(off - (bin - reach_) * kBin_m, params_.scale_m);
    }
    for (int knot = 0; knot < kRimPathKnots; ++knot)
      for (int bin = 0; bin < bins_; ++bin)
        price_[static_cast<std::size_t>(knot) * bins_ + bin] += params_.flat_price * std::abs(bin - reach_) * kBin_m;
  }

  // One knot on: each bin is reached from bin - slope, at the price of the slope's change.
  void advance(const std::vector<double>& cost, std::vector<double>& next, std::vector<unsigned char>& from,
               const double* price) const {
    const double kink = params_.bend_price * kBin_m;
    std::vector<double> spread(states());
    std::vector<unsigned char> best(states());
    for (int bin = 0; bin < bins_; ++bin) {
      double* row = &spread[state(bin, 0)];
      unsigned char* source = &best[state(bin, 0)];
      std::copy_n(&cost[state(bin, 0)], kSlopes, row);
      spread_costs(row, source, kSlopes, kink);
    }
    for (int bin = 0; bin < bins_; ++bin)
      for (int slope = 0; slope < kSlopes; ++slope) {
        const int before = bin - (slope - kSteepest), to = state(bin, slope);
        const bool inside = before >= 0 && before < bins_;
        next[to] = inside ? spread[state(before, slope)] + price[bin] : std::numeric_limits<double>::infinity();
        from[to] = inside ? best[state(before, slope)] : static_cast<unsigned char>(slope);
      }
  }

  const RimPathParams& params_;
  int reach_, bins_;
  std::vector<double> price_;  // per knot and bin
};

}  // namespace

std::vector<double> best_rim_path(const std::vector<RimSample>& samples, const FlatCut& flat,
                                  const RimPathParams& params) {
  std::vector<double> along;
  const std::vector<int> path = PathGrid(samples, flat, params).best();
  for (int knot = 0; knot < kRimPathKnots; ++knot)
    along.push_back(flat.at(rim_knot_angle(knot, kRimPathKnots)) + path[knot] * kBin_m);
  return along;
}

}  // namespace dressform
