#include <algorithm>
#include <cmath>

#include "scenes/error.h"
#include "scenes/import/import.h"
#include "scenes/import/recorded_poses.h"
#include "scenes/import/stamped_files.h"
#include "scenes/json_file.h"
#include "scenes/session_limits.h"

// Recordings of redwood-data.org and of Open3D's recorders: Choi et al., "A large dataset of object scans",
// arXiv:1602.02481. depth/ holds 16-bit PNG, millimetres, on colour's grid; colour is in rgb/, image/, color/ or
// colors/. Files are named by frame, or by frame and microseconds. intrinsic.json as Open3D writes it, and
// trajectory.log or odometry.log with the poses of frames, where they are.
namespace dressform {
namespace {

namespace fs = std::filesystem;

// Open3D's file: size and the columns of the camera matrix, one after the other.
Camera read_intrinsics(const fs::path& file) {
  const JsonValue json = read_json(file);
  const auto matrix = json.at("intrinsic_matrix").numbers(9);
  Camera camera;
  camera.width = json.at("width").whole(1, 16384);
  camera.height = json.at("height").whole(1, 16384);
  camera.fx = matrix[0], camera.fy = matrix[4], camera.cx = matrix[6], camera.cy = matrix[7];
  if (matrix[1] != 0 || matrix[2] != 0 || matrix[3] != 0 || matrix[5] != 0 || matrix[8] != 1)
    json.at("intrinsic_matrix").fail("found no camera matrix; expected [fx, 0, 0, 0, fy, 0, cx, cy, 1]");
  if (const auto found = problem_with(camera)) json.at("intrinsic_matrix").fail(found->field + ": " + found->problem);
  return camera;
}

fs::path first_existing(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (fs::exists(folder / name)) return folder / name;
  return {};
}

std::vector<DepthAndColor> synchronised(const NumberedFiles& depth, const fs::path& color_folder,
                                        const StreamParams& params, const fs::path& depth_folder,
                                        std::vector<std::string>& notes) {
  const NumberedFiles color = numbered_files(color_folder);
  if (!color.files.empty() && color.timed != depth.timed)
    throw InputError(color_folder.string(), "found names of another kind than in " + depth_folder.string() +
                                                "; expected times in both or in neither");
  return with_partners(depth.files, color.files, depth.timed ? 1e-3 * params.tolerance_ms : 0, depth_folder.string(),
                       notes);
}

void read_frames(const fs::path& folder, const RecordingUse& use, const StreamParams& params, Recording& recording) {
  const fs::path depth_folder = folder / "depth";
  const NumberedFiles depth = numbered_files(depth_folder);
  if (depth.files.empty()) throw InputError(depth_folder.string(), "found no images; expected depth frames");
  const fs::path color = first_existing(folder, {"rgb", "image", "color", "colors"});
  if (!color.empty()) {
    for (const auto& [each, partner] : synchronised(depth, color, params, depth_folder, recording.notes))
      recording.frames.push_back({partner.path, {}, each.path});
    return;
  }
  if (use == RecordingUse::shot)
    throw InputError((folder / "rgb").string(), "is missing; expected a folder of colour, which a shot needs");
  for (const auto& each : depth.files) recording.frames.push_back({{}, {}, each.path});
  recording.notes.push_back("no folder of colour: synchronisation was not checked");
}

// By the frame's place among the depth images, which a log counts from 0.
void read_poses(const fs::path& folder, Recording& recording) {
  const fs::path log = first_existing(folder, {"trajectory.log", "odometry.log"});
  if (log.empty()) return;
  const auto depth = numbered_files(folder / "depth").files;
  const auto poses = logged_poses(log);
  if (poses.size() > depth.size())
    throw InputError(log.string(), "found a pose of frame " + std::to_string(poses.size() - 1) +
                                       "; expected frames 0 to " + std::to_string(depth.size() - 1) +
                                       ", as many as there are depth images");
  std::size_t next = 0;  // frames without a partner in colour were left out
  for (RecordedFrame& frame : recording.frames) {
    while (depth[next].path != frame.depth) ++next;
    if (next < poses.size()) frame.world_from_frame = poses[next];
  }
}

Recording redwood(const fs::path& folder, const RecordingUse& use, const StreamParams& params) {
  if (use == RecordingUse::boards) fail_without_infrared(folder);
  Recording recording;
  recording.sensor.model = "kinect_v1";
  recording.prime_sense = true;
  set_stream(recording, params);
  read_frames(folder, use, params, recording);
  read_poses(folder, recording);
  const fs::path intrinsics = first_existing(folder, {"intrinsic.json", "camera_intrinsic.json"});
  if (!intrinsics.empty()) {
    recording.sensor.model = "unknown";  // any sensor that a recorder of Open3D knows
    recording.sensor.ir = read_intrinsics(intrinsics);
    recording.calibrated = true;
  }
  return recording;
}

const Importer::Variant redwood_variant{"redwood", redwood};

}  // namespace
}  // namespace dressform
