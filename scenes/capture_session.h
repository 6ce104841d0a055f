#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"
#include "scenes/frame.h"

namespace dressform {

// Rough poses of the rig: how the sensors were meant to stand. World: y up, floor y = 0, mannequin near the origin.
struct RigPrior {
  std::map<std::string, Isometry3d> world_from_sensor;  // IR camera
  double rotation_sigma_deg = 5.0;
  double translation_sigma_m = 0.08;
};

struct BoardShot {
  cv::Mat color, ir, depth_mm;
};
struct Boards {
  int inner_corners_x = 0, inner_corners_y = 0;
  double square_m = 0;
  std::map<std::string, std::vector<BoardShot>> shots;  // by sensor
};

// All that the pipeline ever sees. On disk: scenes/README.md, "capture session".
struct CaptureSession {
  std::string name, created_by, licence;
  std::vector<std::string> sensors;        // the order of the views
  std::optional<Calibration> calibration;  // absent where boards are to be used
  std::map<std::string, Shot> naked, dressed;
  std::map<std::string, DepthScan> scans;  // "scan_naked", "scan_user"
  std::optional<RigPrior> prior;
  std::optional<Boards> boards;
};

// Strict reader: unknown versions, missing files, wrong sizes or bit depths, matrices that are no rotation, non-finite
// numbers, gaps in a scan and paths that leave the folder throw InputError naming file and field. Never opens `truth/`.
CaptureSession read_capture_session(const std::filesystem::path& folder);

// The same without its images, which are neither opened nor looked for: as many empty ones as there are.
CaptureSession read_session_outline(const std::filesystem::path& folder);

// Names of sensors become folders: letters, digits, `_`, `-` and `.` (not first).
bool is_sensor_name(const std::string& name);

// Writes to a temporary folder beside `folder`, then renames it. Throws InputError when `folder` exists.
void write_capture_session(const std::filesystem::path& folder, const CaptureSession& session);

// Hash (hex) of every file of the session except those under `truth/` and `picks/`, and of their names.
std::string session_content_hash(const std::filesystem::path& folder);

}  // namespace dressform
