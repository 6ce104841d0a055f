#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"
#include "scenes/mesh_frame.h"
#include "scenes/scene.h"

namespace dressform {

// Exit codes of the program, documented in README.md.
enum ExitCode { kSuccess = 0, kRegression = 1, kBadInput = 2, kBadGolden = 3, kCrash = 4, kGarmentsMissing = 5 };

// Options that several commands share.
struct CommonOptions {
  std::filesystem::path output, store;
  Seed seed = 1;
  int threads = 0;  // 0: all cores
  double scale = 1.0;
  std::vector<std::string> variants, values;  // "stage=name", "stage.parameter=value"
  std::string preset;                         // name or file; variants and values override it
  bool quiet = false;
};
void add_output(CLI::App& command, CommonOptions& options, const std::string& what);
void add_threads(CLI::App& command, CommonOptions& options);
void add_choices(CLI::App& command, CommonOptions& options);
void add_preset(CLI::App& command, CommonOptions& options);
void add_scene_options(CLI::App& command, CommonOptions& options);
// --unit, --up and --lift-m of meshes that are given on the command line.
void add_mesh_frame(CLI::App& command, MeshFrame& frame);

// --preset, overridden by --variant and --set, sorted by stage; another variant than the preset's takes nothing of what
// the preset sets for that stage. "sensor" belongs to the scene's sensor model.
struct Choices {
  ReconstructionOptions reconstruction;
  VariantChoice sensor;  // empty variant: as the scene says
};
Choices parse_choices(const CommonOptions& options);

// The scene file with --scale and the sensor model of --variant and --set applied.
Scene chosen_scene(const std::filesystem::path& file, const CommonOptions& options);

// The chosen variants and parameters as one word list for the scores: "default", "surface=rbf_carr
// fuse.voxel_m=0.003" or "thesis surface=rbf_carr".
std::string variant_text(const CommonOptions& options);

// The store of a run: --store, $DRESSFORM_STORE, or ".dressform-store" beside the output folder.
std::filesystem::path store_folder(const CommonOptions& options);

// Sets the number of threads of TBB, OpenMP and OpenCV for as long as it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  int count() const { return count_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  int count_;
};

}  // namespace dressform
