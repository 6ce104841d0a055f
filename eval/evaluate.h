#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "eval/scores.h"
#include "scenes/camera.h"
#include "scenes/ground_truth.h"
#include "scenes/mesh.h"

namespace dressform {

struct GarmentOutput {
  Mesh mesh;              // <slot>.ply
  TexturedMesh textured;  // <slot>.glb; no triangles when absent
  Mesh fitted;            // <slot>_fitted.ply; no triangles when absent
};

// Reprojection of the boards that a sensor was calibrated from.
struct BoardResiduals {
  double ir_rms_px = 0, color_rms_px = 0;
};

// What a run hands to its users, as it lies in RUN/out. What a run did not make is empty or absent.
struct RunOutputs {
  std::map<std::string, Isometry3d> model_from_sensor;  // IR camera
  std::map<std::string, bool> converged;
  std::optional<Calibration> calibration;            // calibration.json
  std::map<std::string, BoardResiduals> boards;      // its key `boards`: sensors calibrated from boards
  std::optional<Isometry3d> user_model_from_frame0;  // optional key of registration.json: first frame of scan_user
  Mesh naked_body, user_body;                        // model frame; the user's own scan's model frame
  std::map<std::string, GarmentOutput> garments;     // "top", "bottom"
  std::map<std::string, cv::Mat> labels;             // by sensor, colour size: 0 none 1 skin 2 top 3 bottom
};

// Reads RUN/out; label images from RUN/stages/*_segment/<sensor>.png or RUN/out/labels/<sensor>.png. Throws
// InputError naming the file that is there but damaged, and when there is no out/registration.json.
RunOutputs read_run_outputs(const std::filesystem::path& run_folder);

struct EvaluateOptions {
  std::string gauge_sensor;           // joins model and world; empty: the first of the truth's sensors by name
  double sample_spacing_m = 0.00125;  // of the points on surfaces
  bool images = true;                 // held-out views (needs the renderer)
  Seed seed = 1;                      // of the sample points
};

// All scores of a run (eval/README.md defines each). The model frame is joined to the world through the gauge sensor
// alone, world_from_model = world_from_sensor(true) * model_from_sensor^-1: nothing is aligned here. Scene, variant and
// seed of the result are left to the caller. Deterministic, whatever the number of threads.
Scores evaluate(const RunOutputs& outputs, const GroundTruth& truth, const EvaluateOptions& options = {});

}  // namespace dressform
