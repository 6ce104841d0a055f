#include "eval/score/evaluate.h"

#include <tbb/parallel_for.h>

#include "eval/score/metric_family.h"
#include "scenes/error.h"

namespace dressform {
namespace {

std::string gauge_of(const GroundTruth& truth, const EvaluateOptions& options) {
  if (options.gauge_sensor.empty())
    return truth.world_from_sensor.empty() ? std::string() : truth.world_from_sensor.begin()->first;
  if (!truth.world_from_sensor.count(options.gauge_sensor))
    throw InputError("truth", "has no sensor \"" + options.gauge_sensor + "\"");
  return options.gauge_sensor;
}

Judged joined_through(const std::string& gauge, const RunOutputs& outputs, const GroundTruth& truth,
                      const EvaluateOptions& options) {
  Judged run{outputs, truth, {}, "failed", gauge, options};
  const auto world_from_gauge = truth.world_from_sensor.find(gauge);
  if (world_from_gauge == truth.world_from_sensor.end())
    run.status_without_world = "absent";
  else if (const auto model_from_gauge = registered_pose(outputs, gauge))
    run.world_from_model = world_from_gauge->second * model_from_gauge->inverse();
  return run;
}

}  // namespace

Scores evaluate(const RunOutputs& outputs, const GroundTruth& truth, const EvaluateOptions& options) {
  const Judged run = joined_through(gauge_of(truth, options), outputs, truth, options);
  const auto families = metric_families();
  std::vector<std::vector<ScoreRow>> parts(families.size());
  tbb::parallel_for(
      std::size_t{0}, families.size(), std::size_t{1}, [&](std::size_t k) { parts[k] = families[k]->judge(run); },
      tbb::simple_partitioner());
  Scores scores;
  for (const auto& part : parts) scores.rows.insert(scores.rows.end(), part.begin(), part.end());
  return scores;
}

}  // namespace dressform
