#pragma once
#include <optional>
#include <string>
#include <vector>

#include "eval/evaluate.h"
#include "eval/score_rows.h"

namespace dressform {

// The parts of evaluate(), one per stage that is judged. Each gives the same rows whatever the run made of it: what
// could not be measured is a row with a status and no number.
namespace evaluation {

// world_from_model through the gauge sensor alone; absent where that sensor was not registered.
std::optional<Isometry3d> world_from_model(const RunOutputs& outputs, const GroundTruth& truth,
                                           const std::string& gauge_sensor);

std::vector<ScoreRow> calibration(const RunOutputs& outputs, const GroundTruth& truth);
std::vector<ScoreRow> bodies(const RunOutputs& outputs, const GroundTruth& truth,
                             const std::optional<Isometry3d>& world_from_model, const EvaluateOptions& options);
std::vector<ScoreRow> registration(const RunOutputs& outputs, const GroundTruth& truth,
                                   const std::optional<Isometry3d>& world_from_model, const std::string& gauge_sensor,
                                   Seed seed);
std::vector<ScoreRow> labels(const RunOutputs& outputs, const GroundTruth& truth);
std::vector<ScoreRow> surfaces(const RunOutputs& outputs, const GroundTruth& truth,
                               const std::optional<Isometry3d>& world_from_model, const EvaluateOptions& options);
std::vector<ScoreRow> openings(const RunOutputs& outputs, const GroundTruth& truth,
                               const std::optional<Isometry3d>& world_from_model);
std::vector<ScoreRow> textures(const RunOutputs& outputs, const GroundTruth& truth,
                               const std::optional<Isometry3d>& world_from_model);
std::vector<ScoreRow> fit(const RunOutputs& outputs, const GroundTruth& truth);
std::vector<ScoreRow> correction(const RunOutputs& outputs, const GroundTruth& truth, Seed seed);

}  // namespace evaluation
}  // namespace dressform
