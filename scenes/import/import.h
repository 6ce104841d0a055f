#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/capture_session.h"
#include "scenes/registry.h"
#include "scenes/session_depth.h"

namespace dressform {

// One moment of a recording. Paths of images; empty: not recorded.
struct RecordedFrame {
  std::filesystem::path color, ir, depth;
  double depth_per_m = 0;                           // of this frame alone; 0: as the recording
  std::optional<Isometry3d> world_from_frame = {};  // of the camera of the depth image, as the recording has it
};

// What another tool left in a folder, before any image but the first is opened.
struct Recording {
  SensorCalibration sensor;           // whose model is known in any case
  bool calibrated = false;            // whether the rest of `sensor` is
  bool prime_sense = false;           // 640 x 480 on colour's grid: PrimeSense's camera where nothing else is known
  bool on_color_grid = false;         // depth was brought to colour's grid: one camera is both
  std::vector<RecordedFrame> frames;  // in order of time
  double depth_per_m = 1000;          // what depth images count in
  std::string depth_scale_option;     // how to say it right: "--set import.depth_per_m"; empty: the format fixes it
  std::vector<int> no_depth{65535};   // values of depth images that mean none, besides 0
  DepthRange range;                   // where its sensor sees anything
  std::string role, sensor_name;      // as the recording itself says; empty: it does not
  std::vector<std::string> notes;     // what was left out, and why
};

// What a recording is to be in a session, which decides what has to be there: a depth scan needs depth alone; a shot
// of one moment needs colour as well, and a calibration; boards need all three images, but no calibration.
enum class RecordingUse { scan, shot, boards };

// Formats of recordings: import/<format>.cpp. Throws InputError naming the file that is missing or wrong.
struct ImporterTag {
  static constexpr const char* name = "import";
  static constexpr const char* default_variant = "iai_kinect2";
};
using Importer = Registry<ImporterTag, Recording(const std::filesystem::path&, const RecordingUse&)>;

struct ImportRequest {
  std::string format;          // of Importer
  FieldValues values;          // its parameters
  std::filesystem::path with;  // a session to take over; empty: none
  std::string role;    // "boards", "naked", "dressed", "scan_naked", "scan_user"; empty: boards or scan_user, whichever
                       // the format is made for
  std::string sensor;  // empty: "handheld" for scans, else "k1"
  std::string model;   // of the sensor, which its noise goes by; empty: what the format is made for
  std::string name;    // of the session; empty: of `with`, or of the folder
  std::string licence;                 // empty: of `with`, or "unknown"
  int first = 0, every = 1, most = 0;  // frames to take: from `first`, every so many, at most so many (0: all)
  int inner_corners_x = 5, inner_corners_y = 7;
  double square_m = 0.03;
  std::optional<Camera> camera;  // instead of the recording's, of the depth images; sizes are the images' own
  std::optional<Isometry3d> world_from_sensor;  // rig prior of a shot's sensor
  double rotation_sigma_deg = 5, translation_sigma_m = 0.08;
};

struct ImportReport {
  std::string role, sensor;
  int frames = 0, recorded = 0;   // written, and found in the recording
  SensorCalibration calibration;  // as written, where there is one
  bool calibrated = false;
  std::vector<std::string> notes;  // what was left out, what the session still lacks
};

// Writes a new capture session (scenes/README.md) from a recording, one frame at a time for every thread. Throws
// InputError, and leaves nothing behind, where the recording does not hold what its role needs, images differ in size
// or bit depth, or `session` exists.
ImportReport import_recording(const std::filesystem::path& recording, const ImportRequest& request,
                              const std::filesystem::path& session);

}  // namespace dressform
