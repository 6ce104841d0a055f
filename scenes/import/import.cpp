#include "scenes/import/import.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>

#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/import/merge_session.h"
#include "scenes/session_folder.h"
#include "scenes/session_layout.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kRoles{"boards", "naked", "dressed", "scan_naked", "scan_user"};

RecordingUse use_of(const std::string& role) {
  if (role == "boards") return RecordingUse::boards;
  return role == "naked" || role == "dressed" ? RecordingUse::shot : RecordingUse::scan;
}

// The request with what was left open filled in.
ImportRequest completed(ImportRequest request, const fs::path& recording) {
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
    const fs::path folder = fs::absolute(recording).lexically_normal();
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
  const std::size_t allowed = request.role == "boards" ? 100 : 10000;
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
  if (use_of(request.role) != RecordingUse::scan) sizes.color = read_image(first.color, kColorOrGreyImage).size();
  return sizes;
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
  }
  if (recording.calibrated || (request.camera && use == RecordingUse::scan)) return sensor;
  if (use == RecordingUse::boards) return {};
  if (recording.prime_sense && sizes.depth == cv::Size(640, 480)) {
    sensor.ir = Camera{640, 480, 525, 525, 319.5, 239.5, {}};
    return sensor;
  }
  const std::string found =
      fmt::format("found no calibration for {} x {} pixels", sizes.depth.width, sizes.depth.height);
  throw InputError(first_depth.string(),
                   found + (recording.prime_sense ? "; expected 640 x 480, whose camera is known, or --camera"
                            : use == RecordingUse::scan
                                ? "; expected calib_ir.yaml beside it, or --camera"
                                : "; expected calib_ir.yaml, calib_color.yaml and calib_pose.yaml beside it"));
}

cv::Mat depth_in_mm(const cv::Mat& depth, double per_m) {
  if (per_m == 1000) return depth;
  cv::Mat result(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x)
      result.at<std::uint16_t>(y, x) = cv::saturate_cast<std::uint16_t>(depth.at<std::uint16_t>(y, x) * 1000.0 / per_m);
  return result;
}

// Reads, checks and writes one frame's images to where the session keeps them.
void write_frame(const RecordedFrame& frame, int index, const ImportRequest& request, double depth_per_m,
                 const Sizes& sizes, const fs::path& session) {
  const RecordingUse use = use_of(request.role);
  const cv::Mat depth = depth_in_mm(read_image(frame.depth, kDepthImage, sizes.depth), depth_per_m);
  if (use == RecordingUse::scan) return write_png(session / request.role / session_layout::depth_frame(index), depth);
  const bool boards = use == RecordingUse::boards;
  const fs::path folder = session / request.role / request.sensor;
  const auto target = [&](const char* what) {
    return folder / (boards ? session_layout::board_image(index, what) : std::string(what) + ".png");
  };
  write_png(target("color"), read_image(frame.color, kColorOrGreyImage, sizes.color));
  write_png(target("ir"), read_image(frame.ir, kDepthImage, sizes.depth));
  write_png(target("depth"), depth);
}

// Frames side by side, as many in memory as there are threads. Of several that are wrong the first is reported.
void write_frames(const std::vector<RecordedFrame>& frames, const ImportRequest& request, double depth_per_m,
                  const Sizes& sizes, const fs::path& session) {
  fs::create_directories(use_of(request.role) == RecordingUse::scan ? session / request.role
                                                                    : session / request.role / request.sensor);
  std::vector<std::exception_ptr> errors(frames.size());
  tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t i) {
    try {
      write_frame(frames[i], static_cast<int>(i), request, depth_per_m, sizes, session);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace

ImportReport import_recording(const fs::path& folder, const ImportRequest& asked, const fs::path& session) {
  if (fs::exists(session)) throw InputError(session.string(), "is there already; expected a new folder");
  const ImportRequest request = completed(asked, folder);
  const RecordingUse use = use_of(request.role);
  Recording recording = Importer::at(request.format).run(folder, use, request.values, 0);
  const auto frames = chosen_frames(recording, request, folder);
  const Sizes sizes = sizes_of(frames.front(), recording, request);
  const auto calibration = calibration_for(recording, request, sizes, frames.front().depth);
  ImportReport report{request.role,
                      request.sensor,
                      static_cast<int>(frames.size()),
                      static_cast<int>(recording.frames.size()),
                      calibration.value_or(SensorCalibration{}),
                      calibration.has_value(),
                      std::move(recording.notes)};
  const CaptureSession outline = merged_session(request, calibration, static_cast<int>(frames.size()), report.notes);
  NewFolder writer(session);
  if (!request.with.empty()) copy_images(request.with, writer.temporary());
  write_frames(frames, request, recording.depth_per_m, sizes, writer.temporary());
  finish_session(writer, outline);
  return report;
}

}  // namespace dressform
