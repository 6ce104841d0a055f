#pragma once
#include <optional>
#include <string>

#include "eval/score/run_outputs.h"
#include "eval/score/scores.h"
#include "scenes/ground_truth.h"

namespace dressform {

struct EvaluateOptions {
  std::string gauge_sensor;           // joins model and world; empty: the first of the truth's sensors by name
  double sample_spacing_m = 0.00125;  // of the points on surfaces
  bool images = true;                 // held-out views (needs the renderer)
  Seed seed = 1;                      // of the sample points
};

// All scores of a run (eval/README.md defines each). The model frame is joined to the world through the gauge sensor
// alone, world_from_model = world_from_sensor(true) * model_from_sensor^-1: nothing is aligned here. What the truth
// does not have gives rows that are `absent`; the rest is scored. Scene, variant and seed of the result are left to the
// caller. Deterministic, whatever the number of threads. Throws InputError for a gauge sensor that the truth does not
// know.
Scores evaluate(const RunOutputs& outputs, const GroundTruth& truth, const EvaluateOptions& options = {});

}  // namespace dressform
