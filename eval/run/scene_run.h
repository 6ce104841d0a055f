#pragma once
#include <filesystem>
#include <string>

#include "eval/run/capture_store.h"
#include "eval/run/road_run.h"
#include "scenes/scene.h"

namespace dressform {

// The whole road from a scene: capture (or the stored one), then run_road.
struct SceneRunRequest {
  Scene scene;       // scaled, with its sensor model chosen
  double scale = 1;  // what it was scaled by, for the records
  std::filesystem::path output, store;
  std::string variant = "default";
  ReconstructionOptions options;
  int threads = 1;
};
struct SceneRunProgress {
  SynthesisProgress capture;
  std::function<void(const StoredCapture&)> captured;
  RoadRunProgress road;
};
RoadRunResult run_scene(const SceneRunRequest& request, const SceneRunProgress& progress = {});

}  // namespace dressform
