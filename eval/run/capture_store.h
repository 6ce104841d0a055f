#pragma once
#include <filesystem>

#include "pipeline/run/artifact_store.h"
#include "scenes/scene.h"
#include "synthetic/synthesize.h"

namespace dressform {

// A scene's synthetic capture, kept in the store under the hash of everything that goes into it.
struct StoredCapture {
  std::filesystem::path session;  // folder: the capture session with its truth/
  Recipe recipe;
  double seconds = 0, peak_memory_mb = 0;
  bool reused = false;
};

// Hash over the scene's text with the files it names (TOML, meshes, textures).
std::string scene_hash(const Scene& scene);

// Captures the scene, or finds the intact capture of an earlier run. Deterministic in (scene, seed).
StoredCapture stored_capture(const Scene& scene, double scale, Seed seed, ArtifactStore& store,
                             const SynthesisProgress& progress);

}  // namespace dressform
