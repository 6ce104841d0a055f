#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "scenes/camera.h"
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

// The garment of a slot, when the run made its surface; null otherwise.
const GarmentOutput* garment_of(const RunOutputs& outputs, const std::string& slot);
// The same, when it was moved to the user.
const GarmentOutput* fitted_garment_of(const RunOutputs& outputs, const std::string& slot);
// Where a sensor stands, when it was registered.
std::optional<Isometry3d> registered_pose(const RunOutputs& outputs, const std::string& sensor);

// Reads RUN/out; label images from RUN/stages/*_segment/<sensor>.png or RUN/out/labels/<sensor>.png. Throws InputError
// naming the file that is there but damaged, and when there is no out/registration.json.
RunOutputs read_run_outputs(const std::filesystem::path& run_folder);

// The same of a folder that may be of someone else's making: refuses what no person or clothes can be, before time is
// spent on it (mesh_bounds.h), and a <slot>.ply and <slot>.glb that are not the same surface.
RunOutputs read_foreign_outputs(const std::filesystem::path& run_folder);

}  // namespace dressform
