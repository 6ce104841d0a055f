#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/studies/draw/draw_scene.h"
#include "eval/studies/foreign_pipeline.h"
#include "eval/studies/study_metric.h"
#include "pipeline/reconstruct.h"

namespace dressform {

// One side of a comparison: what differs from the default pipeline and the scene as it is.
struct StudyVariant {
  std::string name;
  ReconstructionOptions options;           // its seed is the cell's
  VariantChoice sensor;                    // empty: the scene's
  std::filesystem::path rig, scan;         // instead of the scene's; empty: the scene's
  double scale = 0;                        // 0: the study's
  std::vector<std::string> oracles;        // stages that truth stands in for
  std::optional<ForeignPipeline> foreign;  // instead of the pipeline: `options` are empty then
};

// Scenes drawn by the seeds first_seed, first_seed + 1, ...
struct DrawnRange {
  DrawOptions options;
  int first_seed = 1, count = 12;
};

// What is compared on what, and by which measures: declared before anything runs. eval/studies/README.md has the
// format.
struct Study {
  std::string name, description;
  double scale = 1;
  std::vector<Seed> seeds{1};  // of all noise; the same for every variant
  std::string baseline;        // the variant that all others are compared with
  std::vector<StudyVariant> variants;
  std::vector<StudyMetric> metrics;  // primary ones first
  std::vector<std::filesystem::path> scenes, recordings;
  std::vector<DrawnRange> drawn;
};

constexpr std::size_t kMostPrimary = 3;  // more would take the power from each

// Reads a study file. Throws InputError with file, line and column for syntax, unknown keys, stages, variants,
// parameters and metrics, wrong types and ranges, and primary metrics without a margin.
Study read_study(const std::filesystem::path& file);

}  // namespace dressform
