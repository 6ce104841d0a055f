#include "pipeline/landmarks/likeness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dressform {
namespace {

constexpr int kBins = 180;            // of 2 degrees
constexpr int kRefined = 7;           // bins to either side, within which the trunk decides
constexpr int kOtherWay = 20;         // bins: a turn that far off is another answer, not the same one
constexpr double kLead = 1.15;        // that the best turn must have over it
constexpr double kFeetWeight = 0.2;   // of the feet's outlines, against the trunk's: shoes differ
constexpr double kWholeWeight = 0.1;  // of the whole body's, against the trunk's, where it refines
constexpr double kLevelStep = 0.012;  // of the stature

// Of the stature.
struct Span {
  double from, to;
};
constexpr Span kHipsToNeck{0.52, 0.90}, kFeet{0.02, 0.08}, kTrunk{0.52, 0.70};

// How far the body reaches from the axis in each direction (0 = front), at one part of the stature: the trunk's loop,
// or the two legs below it. Over its mean, so that girth does not matter.
std::vector<double> outline(const StandingBody& body, double part) {
  std::vector<double> reach(kBins, 0);
  const double y = body.landmarks.floor_y + part * body.landmarks.stature;
  const int level = body.sections.level(y);
  if (level < 0) return reach;
  const auto& loops = body.sections.levels[level];
  const std::size_t used = std::min<std::size_t>(loops.size(), y < body.landmarks.crotch_y ? 2 : 1);
  for (int bin = 0; bin < kBins; ++bin) {
    const Vector3d direction = body.landmarks.direction(2 * M_PI * bin / kBins);
    for (std::size_t i = 0; i < used; ++i)
      for (const auto& point : loops[i].points)
        reach[bin] = std::max(reach[bin], direction.dot(point - body.landmarks.axis));
  }
  double mean = 0;
  for (double r : reach) mean += r / kBins;
  for (double& r : reach) r = mean > 0 ? r / mean : 0;
  return reach;
}

using Outlines = std::vector<std::vector<double>>;

Outlines outlines(const StandingBody& body, const Span& span) {
  Outlines result;
  for (double part = span.from; part <= span.to; part += kLevelStep) result.push_back(outline(body, part));
  return result;
}

// Mean squared difference with the second body turned by each number of bins.
std::vector<double> differences(const Outlines& a, const Outlines& b) {
  std::vector<double> result(kBins, 0);
  const std::size_t levels = std::min(a.size(), b.size());
  for (int turn = 0; turn < kBins; ++turn)
    for (std::size_t level = 0; level < levels; ++level)
      for (int i = 0; i < kBins; ++i) {
        const double d = a[level][i] - b[level][(i + turn) % kBins];
        result[turn] += d * d / static_cast<double>(levels * kBins);
      }
  return result;
}

int apart(int a, int b) {
  const int d = std::abs(a - b) % kBins;
  return std::min(d, kBins - d);
}

// The turn, in bins with a fraction, nearest to `coarse` at which the trunks agree best; where they are as round as
// columns, the rest of the body decides.
double refined_turn(const StandingBody& known, const StandingBody& body, const std::vector<double>& whole, int coarse) {
  auto cost = differences(outlines(known, kTrunk), outlines(body, kTrunk));
  for (int turn = 0; turn < kBins; ++turn) cost[turn] += kWholeWeight * whole[turn];
  const auto at = [&](int turn) { return cost[(turn + 2 * kBins) % kBins]; };
  int best = coarse;
  for (int turn = coarse - kRefined; turn <= coarse + kRefined; ++turn)
    if (at(turn) < at(best)) best = turn;
  const double before = at(best - 1), here = at(best), after = at(best + 1), bend = before - 2 * here + after;
  const double fraction = bend > 1e-15 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
  return best + fraction;
}

}  // namespace

Likeness likeness(const StandingBody& known, const StandingBody& body) {
  auto cost = differences(outlines(known, kHipsToNeck), outlines(body, kHipsToNeck));
  const auto feet = differences(outlines(known, kFeet), outlines(body, kFeet));
  for (int turn = 0; turn < kBins; ++turn) cost[turn] += kFeetWeight * feet[turn];
  const int best = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  double second = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kBins; ++turn)
    if (apart(turn, best) > kOtherWay) second = std::min(second, cost[turn]);
  return {refined_turn(known, body, cost, best) * 2 * M_PI / kBins, second > kLead * cost[best]};
}

}  // namespace dressform
