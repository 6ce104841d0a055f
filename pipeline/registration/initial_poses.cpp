#include "pipeline/registration/initial_poses.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kHalfBody = 0.08;            // from the mean of the seen surface to the body's axis, metres
constexpr double kHighest = 0.995;            // part of a mannequin's points that lie below its crown
constexpr double kLowest = 0.01;              // part of a mannequin's points that may lie below its soles
constexpr int kRefined = 8;                   // candidates of a view that are looked at closely
constexpr double kSame_rad = 4 * M_PI / 180;  // candidates nearer than this have run into the same place
constexpr double kTieBreak = 0.02;            // of a score per radian: only equals are told apart by it

// From all sides at once with few points, then the best with more. The first width reaches from any of the headings to
// the next minimum; the last leaves what the stage's own loss starts with.
const std::vector<ModelGate> kCoarse{{0.20, 0.3, 200}, {0.08, 0.5, 300}}, kFine{{0.05, 0.6, 800}, {0.025, 0.7, 1500}};
constexpr int kCoarseIterations = 8, kFineIterations = 12;

double heading_of(const Isometry3d& upright_from_sensor) {
  const Vector3d axis = upright_from_sensor.linear().col(2);
  return std::atan2(axis.x(), axis.z());
}

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * M_PI)); }

// The view stood upright: y up, floor y = 0, optical axis towards +z, the mannequin's axis at x = z = 0.
Isometry3d upright_from_sensor(const ViewPoints& view, const ModelTarget& target) {
  Vector3d up(0, -1, 0);
  if (view.floor_plane)
    up = view.floor_plane->head<3>();
  else if (view.world_from_sensor)
    up = view.world_from_sensor->linear().transpose() * Vector3d::UnitY();
  Isometry3d upright = Isometry3d::Identity();
  upright.linear() = rotation_between(up, Vector3d::UnitY());
  upright = Isometry3d(Eigen::AngleAxisd(-heading_of(upright), Vector3d::UnitY())) * upright;
  std::vector<double> x, y, z;
  for (const int i : view.body) {
    const Vector3d p = upright * view.map.points[i].cast<double>();
    x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
  }
  // Without a floor the lowest of the mannequin stands on it; where the model has none, heads are where heads are.
  const double height = !target.has_floor() ? target.top_m() - lower_quantile(y, kHighest)
                        : view.floor_plane  ? (*view.floor_plane)[3]
                                            : -lower_quantile(y, kLowest);
  upright.translation() = Vector3d(-lower_quantile(x, 0.5), height, -lower_quantile(z, 0.5) - kHalfBody);
  return upright;
}

struct Candidate {
  ViewAlignment alignment;
  double score = std::numeric_limits<double>::infinity();
  double heading = 0;
};

double score(const ViewPoints& view, const ModelTarget& target, const Projector& projector,
             const ViewAlignment& alignment, const InitialPoseOptions& options) {
  if (!alignment.valid) return std::numeric_limits<double>::infinity();
  return alignment.cost +
         contradicted_part(view, target, projector, alignment.model_from_sensor, options.contradiction_m);
}

std::vector<Candidate> candidates(const ViewPoints& view, const ModelTarget& target,
                                  const InitialPoseOptions& options) {
  const Isometry3d upright = upright_from_sensor(view, target);
  const Projector projector(view.map.camera);
  std::vector<Candidate> all(options.headings);
  tbb::parallel_for(0, options.headings, [&](int k) {
    const Isometry3d start(Eigen::AngleAxisd(2 * M_PI * k / options.headings, Vector3d::UnitY()));
    all[k].alignment = align_to_model(view, target, start * upright, kCoarse, kCoarseIterations);
    all[k].score = score(view, target, projector, all[k].alignment, options);
    all[k].heading = heading_of(all[k].alignment.model_from_sensor);
  });
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  std::vector<Candidate> distinct;
  for (const auto& each : all) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](const Candidate& other) {
      return angle_between(each.heading, other.heading) < kSame_rad;
    });
    if (!known && each.alignment.valid && distinct.size() < kRefined) distinct.push_back(each);
  }
  tbb::parallel_for(std::size_t{0}, distinct.size(), [&](std::size_t k) {
    Candidate& each = distinct[k];
    each.alignment = align_to_model(view, target, each.alignment.model_from_sensor, kFine, kFineIterations);
    each.score = score(view, target, projector, each.alignment, options);
    each.heading = heading_of(each.alignment.model_from_sensor);
  });
  return distinct;
}

// The candidate that fits best within reach of a heading; nullptr without one.
const Candidate* best_near(const std::vector<Candidate>& candidates, double heading, double reach) {
  const Candidate* best = nullptr;
  for (const auto& each : candidates)
    if (angle_between(each.heading, heading) < reach && (!best || each.score < best->score)) best = &each;
  return best;
}

const Candidate* best_of(const std::vector<Candidate>& candidates) { return best_near(candidates, 0, 2 * M_PI); }

// The heading of the world in the model frame that suits all views with a prior best.
double common_heading(const std::vector<ViewPoints>& views, const std::vector<std::vector<Candidate>>& candidates,
                      double reach) {
  constexpr int kSteps = 120;
  constexpr double kNone = 2;  // a score worse than any
  double best = 0, best_sum = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kSteps; ++k) {
    const double heading = 2 * M_PI * k / kSteps;
    double sum = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
      if (!views[v].usable() || !views[v].world_from_sensor) continue;
      const double expected = heading + heading_of(*views[v].world_from_sensor);
      const Candidate* found = best_near(candidates[v], expected, reach);
      // Among equals the heading in the middle of what the views allow.
      sum += found ? std::min(kNone, found->score + kTieBreak * angle_between(found->heading, expected)) : kNone;
    }
    if (sum < best_sum) best_sum = sum, best = heading;
  }
  return best;
}

}  // namespace

std::vector<ViewAlignment> initial_poses(const std::vector<ViewPoints>& views, const ModelTarget& target,
                                         const InitialPoseOptions& options) {
  std::vector<std::vector<Candidate>> found(views.size());
  for (std::size_t v = 0; v < views.size(); ++v)
    if (views[v].usable()) found[v] = candidates(views[v], target, options);
  const double reach = options.prior_reach_deg * M_PI / 180;
  const double heading = common_heading(views, found, reach);
  std::vector<ViewAlignment> result(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    const Candidate* best = views[v].world_from_sensor
                                ? best_near(found[v], heading + heading_of(*views[v].world_from_sensor), reach)
                                : best_of(found[v]);
    if (best) result[v] = best->alignment;
  }
  return result;
}

}  // namespace dressform
