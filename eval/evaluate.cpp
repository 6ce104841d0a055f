#include "eval/evaluate.h"

#include <tbb/parallel_invoke.h>

#include "eval/evaluate_parts.h"
#include "scenes/error.h"

namespace dressform {

Scores evaluate(const RunOutputs& outputs, const GroundTruth& truth, const EvaluateOptions& options) {
  if (truth.world_from_sensor.empty()) throw InputError("truth", "has no sensors; expected their poses");
  const std::string gauge =
      options.gauge_sensor.empty() ? truth.world_from_sensor.begin()->first : options.gauge_sensor;
  if (!truth.world_from_sensor.count(gauge)) throw InputError("truth", "has no sensor \"" + gauge + "\"");
  const auto world_from_model = evaluation::world_from_model(outputs, truth, gauge);
  std::vector<std::vector<ScoreRow>> parts(9);  // in the order of the stages
  parts[0] = evaluation::calibration(outputs, truth);
  tbb::parallel_invoke(
      [&] { parts[1] = evaluation::bodies(outputs, truth, world_from_model, options); },
      [&] { parts[2] = evaluation::registration(outputs, truth, world_from_model, gauge, options.seed); },
      [&] { parts[3] = evaluation::labels(outputs, truth); },
      [&] { parts[4] = evaluation::surfaces(outputs, truth, world_from_model, options); },
      [&] { parts[5] = evaluation::openings(outputs, truth, world_from_model); },
      [&] {
        if (options.images) parts[6] = evaluation::textures(outputs, truth, world_from_model);
      },
      [&] { parts[7] = evaluation::fit(outputs, truth); },
      [&] { parts[8] = evaluation::correction(outputs, truth, options.seed); });
  Scores scores;
  for (const auto& part : parts) scores.rows.insert(scores.rows.end(), part.begin(), part.end());
  return scores;
}

}  // namespace dressform
