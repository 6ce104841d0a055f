#include "scenes/import/import.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/import/frame_writer.h"
#include "scenes/import/merge_session.h"
#include "scenes/scan_poses.h"
#include "scenes/session_folder.h"
#include "scenes/session_layout.h"
#include "scenes/session_limits.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kRoles{"boards", "naked", "dressed", "scan_naked", "scan_user"};

RecordingUse use_of(const std::string& role) {
  if (role == "boards") return RecordingUse::boards;
  return role == "naked" || role == "dressed" ? RecordingUse::shot : RecordingUse::scan;
}

// The request with what was left open filled in, by the recording where it says so itself.
ImportRequest completed(ImportRequest request, const Recording& recording, const fs::path& path) {
  if (request.role.empty()) request.role = recording.role;
  if (request.sensor.empty()) request.sensor = recording.sensor_name;
  if (request.role.empty()) request.role = request.format == Importer::default_variant() ? "boards" : "scan_user";
  if (std::find(kRoles.begin(), kRoles.end(), request.role) == kRoles.end())
    throw InputError("--role " + request.role, "expected boards, naked, dressed, scan_naked or scan_user");
  const RecordingUse use = use_of(request.role);
  if (request.sensor.empty()) request.sensor = use == RecordingUse::scan ? "handheld" : "k1";
  if (!is_sensor_name(request.sensor))
    throw InputError("--sensor " + request.sensor, "expected letters, digits, _, - and . (not first)");
  if (request.world_from_sensor && use == RecordingUse::scan)
    throw InputError("--place", "found for a scan; expected it for a sensor of the rig, with another --role");
  if (request.name.empty() && request.with.empty()) {
    const fs::path folder = fs::absolute(path).lexically_normal();
    request.name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  }
  return request;
}

std::vector<RecordedFrame> chosen_frames(const Recording& recording, const ImportRequest& request,
                                         const fs::path& folder) {
  std::vector<RecordedFrame> frames;
  const bool shot = use_of(request.role) == RecordingUse::shot;
  const std::size_t most = shot ? 1 : request.most > 0 ? request.most : recording.frames.size();
  for (std::size_t i = request.first; i < recording.frames.size() && frames.size() < most; i += request.every)
    frames.push_back(recording.frames[i]);
  if (frames.empty())
    throw InputError(folder.string(), fmt::format("found {} frames; expected one from --first {}",
                                                  recording.frames.size(), request.first));
  const std::size_t allowed = session_layout::kMostFrames;
  if (frames.size() > allowed)
    throw InputError(folder.string(), fmt::format("found {} frames; expected {} at most, which is what a session "
                                                  "allows: --every, --first and --frames choose",
                                                  frames.size(), allowed));
  return frames;
}

// Sizes of the recording's images: those of its calibration, else of the first; all others have to have them.
struct Sizes {
  cv::Size color, depth;
};
Sizes sizes_of(const RecordedFrame& first, const Recording& recording, const ImportRequest& request) {
  const bool known = recording.calibrated && !request.camera;
  const Camera& camera = recording.sensor.ir;
  Sizes sizes;
  sizes.depth = read_image(first.depth, kDepthImage, known ? cv::Size(camera.width, camera.height) : cv::Size()).size();
  if (use_of(request.role) == RecordingUse::scan) return sizes;
  const auto& color = recording.sensor.color;
  sizes.color =
      read_image(first.color, kColorOrGreyImage, known && color ? cv::Size(color->width, color->height) : cv::Size())
          .size();
  return sizes;
}

[[noreturn]] void fail_without_calibration(const Recording& recording, RecordingUse use, const Sizes& sizes,
                                           const fs::path& first_depth) {
  const std::string found =
      fmt::format("found no calibration for {} x {} pixels", sizes.depth.width, sizes.depth.height);
  throw InputError(first_depth.string(),
                   found + (recording.prime_sense     ? "; expected 640 x 480, whose camera is known, or --camera"
                            : recording.on_color_grid ? "; expected --camera"
                            : use == RecordingUse::scan
                                ? "; expected calib_ir.yaml beside it, or --camera"
                                : "; expected calib_ir.yaml, calib_color.yaml and calib_pose.yaml beside it"));
}

// The recording's calibration, or the one that the request gives instead; nothing where boards are to give it.
std::optional<SensorCalibration> calibration_for(const Recording& recording, const ImportRequest& request,
                                                 const Sizes& sizes, const fs::path& first_depth) {
  SensorCalibration sensor = recording.sensor;
  const RecordingUse use = use_of(request.role);
  if (!request.model.empty()) sensor.model = request.model;
  if (request.camera) {
    sensor.ir = *request.camera;
    sensor.ir.width = sizes.depth.width, sensor.ir.height = sizes.depth.height;
    if (const auto found = problem_with(sensor.ir)) throw InputError("--camera", found->field + ": " + found->problem);
  }
  const bool prime_sense = recording.prime_sense && sizes.depth == cv::Size(640, 480);
  const bool given = request.camera && (use == RecordingUse::scan || recording.on_color_grid);
  if (!recording.calibrated && !given) {
    if (use == RecordingUse::boards) return {};
    if (!prime_sense) fail_without_calibration(recording, use, sizes, first_depth);
    sensor.ir = Camera{640, 480, 525, 525, 319.5, 239.5, {}};
  }
  if (recording.on_color_grid) sensor.color.reset();
  if (recording.on_color_grid && use != RecordingUse::scan) {
    if (sizes.color != sizes.depth)
      throw InputError(first_depth.string(),
                       fmt::format("found {} x {} pixels of depth and {} x {} of colour; expected depth on colour's "
                                   "grid, so images of one size",
                                   sizes.depth.width, sizes.depth.height, sizes.color.width, sizes.color.height));
    sensor.color = sensor.ir;
    sensor.color_from_ir = Isometry3d::Identity();
  }
  return sensor;
}

// Every image that the role needs.
void check_whole(const std::vector<RecordedFrame>& frames, RecordingUse use, const fs::path& folder) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool color = !frames[i].color.empty(), ir = !frames[i].ir.empty(), depth = !frames[i].depth.empty();
    const char* missing = !depth                                ? "depth"
                          : use != RecordingUse::scan && !color ? "colour"
                          : use == RecordingUse::boards && !ir  ? "infrared"
                                                                : nullptr;
    if (missing)
      throw InputError(folder.string(), fmt::format("found no {} image of frame {}; expected depth for a scan, colour "
                                                    "as well for a shot, and infrared too for boards",
                                                    missing, i));
  }
}

// The frames' poses, where the recording has any.
void keep_poses(const std::vector<RecordedFrame>& frames, DepthScan& scan, std::vector<std::string>& notes) {
  const auto known = std::count_if(frames.begin(), frames.end(), [](const auto& f) { return f.world_from_frame; });
  if (known == 0) return;
  for (const auto& frame : frames) scan.world_from_frame.push_back(frame.world_from_frame.value_or(no_pose()));
  notes.push_back(
      fmt::format("{} of {} frames have a recorded pose, which fuse's known_poses takes", known, frames.size()));
}

}  // namespace

ImportReport import_recording(const fs::path& folder, const ImportRequest& asked, const fs::path& session) {
  if (fs::exists(session)) throw InputError(session.string(), "is there already; expected a new folder");
  ImportRequest request = completed(asked, {}, folder);
  Recording recording = Importer::at(request.format).run(folder, use_of(request.role), request.values, 0);
  request = completed(asked, recording, folder);
  const RecordingUse use = use_of(request.role);
  const auto frames = chosen_frames(recording, request, folder);
  check_whole(frames, use, folder);
  const Sizes sizes = sizes_of(frames.front(), recording, request);
  const auto calibration = calibration_for(recording, request, sizes, frames.front().depth);
  ImportReport report{request.role,
                      request.sensor,
                      static_cast<int>(frames.size()),
                      static_cast<int>(recording.frames.size()),
                      calibration.value_or(SensorCalibration{}),
                      calibration.has_value(),
                      recording.notes};
  CaptureSession outline = merged_session(request, calibration, static_cast<int>(frames.size()), report.notes);
  if (use == RecordingUse::scan) keep_poses(frames, outline.scans.at(request.role), report.notes);
  NewFolder writer(session);
  if (!request.with.empty()) copy_images(request.with, writer.temporary());
  write_frames(frames, recording, {writer.temporary(), request.role, request.sensor, use, sizes.color, sizes.depth},
               folder, report.notes);
  finish_session(writer, outline);
  return report;
}

}  // namespace dressform
