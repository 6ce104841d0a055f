#pragma once
#include <filesystem>
#include <string>

#include "eval/run/capture_store.h"
#include "eval/run/end_to_end.h"
#include "scenes/scene.h"

namespace dressform {

// Gives the scene another sensor model, or other parameters of its own one; an empty choice leaves it as it is. Another
// model takes none of the scene's parameters. Throws InputError for a model or parameter that is not known, and for
// values out of range.
void choose_sensor(Scene& scene, const VariantChoice& choice);

// The whole pipeline from a scene: capture (or the stored one), then run_end_to_end.
struct SceneRunRequest {
  Scene scene;       // scaled, with its sensor model chosen
  double scale = 1;  // what it was scaled by, for the records
  std::filesystem::path output, store;
  std::string variant = "default";
  ReconstructionOptions options;
  int threads = 1;
  bool report = true;  // these three: see EndToEndRequest
  bool result_images = false;
  std::vector<std::string> oracles = {};
};
struct SceneRunProgress {
  SynthesisProgress capture;
  std::function<void(const StoredCapture&)> captured;
  EndToEndProgress pipeline;
};
EndToEndResult run_scene(const SceneRunRequest& request, const SceneRunProgress& progress = {});

}  // namespace dressform
