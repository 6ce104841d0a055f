#include <algorithm>
#include <array>
#include <limits>

#include "eval/metrics/registration_metrics.h"
#include "eval/score/metric_family.h"

namespace dressform {
namespace {
using namespace metrics;

constexpr double kTargetSpacing_m = 0.02;  // of the points that the target error is taken over: some 5000 a view

void judge_registration(const Judged& run, StageRows& rows);

// The first sensor joins model and world: it has no error of its own.
const MetricFamily registration_metrics{
    "registration",
    "registration",
    {Metric{"<sensor>/rotation_deg", 1, "deg", Better::lower,
            "2 atan2(abs(q_v), abs(q_w)) of R_estimate R_true^T. Sensor \"max\" is the worst one; the gauge sensor has "
            "no error of its own."}
         .with_target(0.5, 1.0)
         .with_headline("worst rotation")
         .for_only("max"),
     {"<sensor>/translation_mm", 1, "mm", Better::lower, "Distance of the camera centres."},
     Metric{"<sensor>/tre_mm", 1, "mm", Better::lower,
            "Target registration error: root mean square of abs(T_estimate p - T_true p) over points of the true naked "
            "body that face the sensor with a free line of sight."}
         .with_target(4, 0.6)
         .with_headline("worst target error")
         .for_only("max")
         .after("Fitzpatrick, West, Maurer, TMI 1998")},
    judge_registration};

constexpr std::size_t kValues = 3, kTargetError = 2;  // in the order of the declarations

struct SensorError {
  std::array<double, kValues> values;
  long targets = 0;
};

SensorError error_of(const Isometry3d& estimate, const Isometry3d& truth, const Mesh& naked_body, Seed seed) {
  SensorError error{{rotation_error_deg(estimate, truth), translation_error_mm(estimate, truth), 0}, 0};
  if (naked_body.triangles.empty()) return error;
  const auto targets = points_seen(naked_body, truth, kTargetSpacing_m, seed);
  error.values[kTargetError] = target_registration_error_mm(estimate, truth, targets);
  error.targets = static_cast<long>(targets.size());
  return error;
}

void judge_registration(const Judged& run, StageRows& rows) {
  const auto& metrics = registration_metrics.metrics();
  const bool has_targets = !run.truth.naked_body.triangles.empty();
  const bool has_poses = run.status_without_world != "absent";
  const auto add_all = [&](const std::string& sensor, const auto& add) {
    for (std::size_t k = 0; k < kValues; ++k)
      if (!has_poses || (k == kTargetError && !has_targets))
        rows.absent(metrics[k].name, {sensor});
      else
        add(metrics[k].name, k);
  };
  std::array<double, kValues> worst{};
  bool all = run.world_from_model.has_value();
  for (const auto& [sensor, pose] : run.truth.world_from_sensor) {
    if (sensor == run.gauge_sensor) continue;
    const auto estimate = registered_pose(run.outputs, sensor);
    if (!estimate || !run.world_from_model) {
      all = false;
      add_all(sensor, [&, name = sensor](const std::string& metric, std::size_t) { rows.fail(metric, {name}); });
      continue;
    }
    const SensorError error = error_of(*run.world_from_model * *estimate, pose, run.truth.naked_body, run.options.seed);
    add_all(sensor, [&, name = sensor](const std::string& metric, std::size_t k) {
      rows.add(metric, {name}, error.values[k], k == kTargetError ? error.targets : 1);
      worst[k] = std::max(worst[k], error.values[k]);
    });
  }
  add_all("max", [&](const std::string& metric, std::size_t k) {
    if (all)
      rows.add(metric, {"max"}, worst[k], static_cast<long>(run.truth.world_from_sensor.size()) - 1);
    else
      rows.fail(metric, {"max"});
  });
}

}  // namespace
}  // namespace dressform
