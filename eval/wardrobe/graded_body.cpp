#include "eval/wardrobe/graded_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "eval/metrics/girths.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr int kRounds = 4;              // the tape finds other levels on a body of other girths
constexpr double kCloseEnough = 0.001;  // of a girth: a millimetre

metrics::TapeLevels levels_of_body(const Mesh& body, const std::string& whose) {
  const auto levels = metrics::tape_levels(body);
  if (!levels) throw InputError(whose, "found no trunk that a tape goes round; expected a standing body, m, y up");
  return *levels;
}

// Scale across at a height: knots from below, ends constant.
struct ScaleAtHeight {
  std::array<double, 3> y, scale;
  double operator()(double height) const {
    if (height <= y[0]) return scale[0];
    for (int k = 1; k < 3; ++k)
      if (height <= y[k]) return scale[k - 1] + (scale[k] - scale[k - 1]) * (height - y[k - 1]) / (y[k] - y[k - 1]);
    return scale[2];
  }
  double farthest_from_one() const {
    double farthest = 0;
    for (const double each : scale) farthest = std::max(farthest, std::abs(each - 1));
    return farthest;
  }
};

// Vertices of the arms below the armpit, which hang beside the trunk.
std::vector<char> hanging_arms(const KnownBody& body, double armpit_y) {
  std::vector<char> arms(body.body.vertices.size(), 0);
  for (std::size_t t = 0; t < body.body.triangles.size(); ++t) {
    if (!is_arm(body.landmarks.triangle_parts[t])) continue;
    for (const int v : body.body.triangles[t]) arms[v] = body.body.vertices[v].y() < armpit_y;
  }
  return arms;
}

}  // namespace

BodyGirths girths_of(const Mesh& body, const std::string& whose) {
  const auto levels = levels_of_body(body, whose);
  return {levels.chest.girth_m, levels.waist.girth_m, levels.hip.girth_m};
}

KnownBody graded_body(const KnownBody& body, const BodyGirths& wanted, const std::string& whose) {
  require_known(body, whose);
  const std::vector<char> arms = hanging_arms(body, levels_of_body(body.body, whose).armpit_y);
  KnownBody graded = body;
  for (int round = 0; round < kRounds; ++round) {
    const auto levels = levels_of_body(graded.body, whose);
    const ScaleAtHeight scale_at{{levels.hip.y, levels.waist.y, levels.chest.y},
                                 {wanted.hip_m / levels.hip.girth_m, wanted.waist_m / levels.waist.girth_m,
                                  wanted.chest_m / levels.chest.girth_m}};
    if (scale_at.farthest_from_one() < kCloseEnough) break;
    for (std::size_t v = 0; v < arms.size(); ++v) {
      Vector3d& p = graded.body.vertices[v];
      const double scale = arms[v] ? scale_at.scale[2] : scale_at(p.y());
      p.x() = body.landmarks.axis.x() + scale * (p.x() - body.landmarks.axis.x());
      p.z() = body.landmarks.axis.z() + scale * (p.z() - body.landmarks.axis.z());
    }
  }
  const Vector3d& front = body.landmarks.front;
  graded.landmarks = with_front(find_landmarks(graded.body, front), front);
  return graded;
}

}  // namespace dressform
