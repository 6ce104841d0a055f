#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibrate/calibrate.h"
#include "pipeline/correct/correct.h"
#include "pipeline/landmarks/landmarks.h"
#include "pipeline/multipath/multipath.h"
#include "pipeline/run/artifact_store.h"
#include "pipeline/run/given_artifacts.h"
#include "pipeline/run/lazy_artifact.h"
#include "scenes/picks.h"

namespace dressform {

// Which variant of each stage, with what parameters. Stages that are not named run their default variant.
struct ReconstructionOptions {
  std::map<std::string, std::string> variants;  // stage -> variant
  std::map<std::string, FieldValues> values;    // stage -> parameter -> value
  Seed seed = 1;
};

// Another variant of a stage takes nothing of what was set for the one before; the same variant again changes nothing.
// Whether there are such a stage and variant is check_options' to say.
void choose_variant(ReconstructionOptions& options, const std::string& stage, const std::string& variant);

// What one stage did in this run.
struct StageRecord {
  int number = 0;
  std::string label;  // the stage's name, or "fuse_naked", "fuse_user"
  Recipe recipe;
  std::string key;     // of the recipe: where the artifact lies in the store
  double seconds = 0;  // of the run that made the artifact
  double peak_memory_mb = 0;
  bool reused = false;
  std::string content_hash;  // of the result; empty while it is being made
};
using StageProgress = std::function<void(const StageRecord&, bool finished)>;

// A capture session as the pipeline takes it: content hashes at once, images only when a stage asks for them.
struct SessionSource {
  LazyArtifact<CaptureSession> session;
  LazyArtifact<DepthScan> scan_naked;
  std::optional<LazyArtifact<DepthScan>> scan_user;  // absent: the garments are made but not fitted
  std::vector<std::string> sensors;
  std::string scan_naked_sensor, scan_user_sensor;
  std::optional<LazyArtifact<Picks>> picks;  // what a person picked by hand, in the frames it was picked in
};
// `check` reads and checks the whole session now, so that a damaged file is an InputError before anything is written.
SessionSource open_session(const std::filesystem::path& folder, bool check);

// Everything the pipeline makes, in its order.
struct Reconstruction {
  std::vector<std::string> sensors;
  LazyArtifact<Calibrated> calibrated;
  LazyArtifact<Calibration> calibration;  // its cameras
  LazyArtifact<Multipath> multipath;
  LazyArtifact<BodyModel> naked;
  LazyArtifact<ExtractedViews> extracted;
  LazyArtifact<Registration> registration;
  LazyArtifact<Landmarks> landmarks;  // of the naked body
  LazyArtifact<Segmentation> segmentation;
  LazyArtifact<FilledViews> filled;
  LazyArtifact<ClosedGarments> closed;
  LazyArtifact<OpenGarments> opened;
  LazyArtifact<TexturedGarments> textured;
  std::optional<LazyArtifact<BodyModel>> user;
  std::optional<LazyArtifact<Landmarks>> user_landmarks;
  std::optional<LazyArtifact<FittedGarments>> fitted;
  std::optional<LazyArtifact<CorrectedGarments>> corrected;
  std::vector<StageRecord> records;
};

// The whole pipeline. Throws InputError for unknown stages, variants and parameters, and for picks that a variant needs
// and the session lacks, before any stage runs. Stages whose results are `given` do not run.
Reconstruction reconstruct(const SessionSource& source, const ReconstructionOptions& options, ArtifactStore& store,
                           const StageProgress& progress = {}, const GivenArtifacts& given = {});

// The registered stages in the order of the pipeline, with their variants and parameters: for --help, checks and
// reports.
struct StageDescription {
  struct VariantDescription {
    std::string name;
    std::vector<FieldInfo> fields;
    std::vector<std::string> picks;  // names of what a person has to pick for it; empty: nothing
  };
  std::string name, default_variant;
  std::vector<VariantDescription> variants;
};
std::vector<StageDescription> describe_stages();

// Throws InputError naming the option where a stage, variant or parameter is not known or out of range.
void check_options(const ReconstructionOptions& options);

}  // namespace dressform
