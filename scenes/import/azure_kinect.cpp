#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/import/import.h"
#include "scenes/import/rational_lens.h"
#include "scenes/import/stamped_files.h"
#include "scenes/json_file.h"
#include "scenes/session_limits.h"

// Recordings of Azure Kinect's k4arecorder (.mkv), unpacked: the tracks as folders of images, color/ (JPEG or PNG),
// depth/ (16-bit PNG, millimetres) and ir/ (16-bit PNG), named by frame or by frame and microseconds, e.g.
//   ffmpeg -i a.mkv -map 0:0 color/%05d.png -map 0:1 -pix_fmt gray16be depth/%05d.png -map 0:2 -pix_fmt gray16be ...
// and the attachment calibration.json (mkvextract a.mkv attachments 1:calibration.json), which is the device's raw
// calibration: parameters in parts of the sensor's size, 14 numbers cx, cy, fx, fy, k1 to k6, codx, cody, p2, p1, and
// camera from depth camera, metres. What of the sensor an image shows goes by its size: Azure Kinect Sensor SDK 1.4,
// "mode specific calibration".
namespace dressform {
namespace {

namespace fs = std::filesystem;

struct AzureKinectParams {
  double tolerance_ms = 20;
  int no_depth = 65535;
};
template <class V>
void fields(V& v, AzureKinectParams& p) {
  v("tolerance_ms", p.tolerance_ms, 0.0, 1000.0, "ms", "how far apart in time the images of one moment may be");
  v("no_depth", p.no_depth, 0, 65535, "", "value of depth images that means none, besides 0 and 65535");
}

// An image is a crop of the sensor, perhaps of 2 x 2 pixels binned into one.
struct Mode {
  cv::Size image, sensor;
  cv::Point corner;
};
const std::vector<Mode> kDepthModes{{{320, 288}, {512, 512}, {96, 90}},
                                    {{640, 576}, {1024, 1024}, {192, 180}},
                                    {{512, 512}, {512, 512}, {0, 0}},
                                    {{1024, 1024}, {1024, 1024}, {0, 0}}};
const std::vector<Mode> kColorModes{{{1280, 720}, {1280, 960}, {0, 120}},   {{1920, 1080}, {1920, 1440}, {0, 180}},
                                    {{2560, 1440}, {2560, 1920}, {0, 240}}, {{2048, 1536}, {2048, 1536}, {0, 0}},
                                    {{3840, 2160}, {3840, 2880}, {0, 360}}, {{4096, 3072}, {4096, 3072}, {0, 0}}};

const Mode& mode_of(const std::vector<Mode>& modes, cv::Size size, const fs::path& image) {
  const auto found = std::find_if(modes.begin(), modes.end(), [&](const Mode& mode) { return mode.image == size; });
  if (found != modes.end()) return *found;
  std::string known;
  for (const auto& mode : modes)
    known += fmt::format("{}{} x {}", known.empty() ? "" : ", ", mode.image.width, mode.image.height);
  throw InputError(image.string(),
                   fmt::format("found {} x {} pixels; expected one of the camera's modes, not scaled or "
                               "cropped: {}",
                               size.width, size.height, known));
}

// One camera of the raw calibration.
class RawCamera {
 public:
  explicit RawCamera(JsonValue value) : value_(std::move(value)) {}

  Camera of_mode(const Mode& mode, const char* what, std::vector<std::string>& notes) const {
    const JsonValue intrinsics = value_.at("Intrinsics");
    const JsonValue model = intrinsics.at("ModelType");
    if (model.text() != "CALIBRATION_LensDistortionModelBrownConrady")
      model.fail("found \"" + model.text() + "\"; expected CALIBRATION_LensDistortionModelBrownConrady");
    const JsonValue parameters = intrinsics.at("ModelParameters");
    const auto p = parameters.numbers(14);
    if (p[10] != 0 || p[11] != 0) parameters.fail("found a centre of distortion (codx, cody); expected 0, 0");
    Camera camera;
    camera.width = mode.image.width, camera.height = mode.image.height;
    camera.fx = p[2] * mode.sensor.width, camera.fy = p[3] * mode.sensor.height;
    camera.cx = p[0] * mode.sensor.width - mode.corner.x - 0.5;  // pixel centres at integers
    camera.cy = p[1] * mode.sensor.height - mode.corner.y - 0.5;
    check(camera, parameters);
    const double seen = value_.has("MetricRadius") ? value_.at("MetricRadius").number() : 0;
    const auto fit = with_polynomial_lens(camera, {{p[4], p[5], p[6], p[7], p[8], p[9]}, p[13], p[12]},
                                          seen > 1e-4 ? seen : kUsualRadius);
    if (fit.rms_px > kWorstLens_px)
      parameters.fail(
          fmt::format("found a lens that the five coefficients of a session miss by {:.1f} px; expected at "
                      "most {:g} px (a narrower mode)",
                      fit.rms_px, kWorstLens_px));
    check(fit.camera, parameters);
    notes.push_back(
        fmt::format("lens of {}: six radial coefficients became three, off by {:.2f} px rms, {:.2f} px at "
                    "the image's corner",
                    what, fit.rms_px, fit.worst_px));
    return fit.camera;
  }

  // Camera from the depth camera's rig.
  Isometry3d extrinsics() const {
    const JsonValue step = value_.at("Rt");
    const auto r = step.at("Rotation").numbers(9), t = step.at("Translation").numbers(3);
    const auto rows =
        nlohmann::json{{r[0], r[1], r[2], t[0]}, {r[3], r[4], r[5], t[1]}, {r[6], r[7], r[8], t[2]}, {0, 0, 0, 1}};
    return JsonValue(step.where() + ".Rotation", rows).rigid();
  }

 private:
  static constexpr double kUsualRadius = 1.7;  // 120 degrees, where the calibration does not say
  static constexpr double kWorstLens_px = 2;   // root mean square
  static void check(const Camera& camera, const JsonValue& where) {
    if (const auto found = problem_with(camera)) where.fail(found->field + ": " + found->problem);
  }
  JsonValue value_;
};

RawCamera camera_at(const JsonValue& file, const std::string& location) {
  const JsonValue cameras = file.at("CalibrationInformation").at("Cameras");
  for (const auto& camera : cameras.elements())
    if (camera.at("Location").text() == "CALIBRATION_CameraLocation" + location) return RawCamera(camera);
  cameras.fail("found no camera at CALIBRATION_CameraLocation" + location + "; expected D0 (depth) and PV0 (colour)");
}

void read_calibration(const fs::path& folder, Recording& recording) {
  const JsonValue file = read_json(folder / "calibration.json");
  const RecordedFrame& first = recording.frames.front();
  const RawCamera depth = camera_at(file, "D0");
  const cv::Size size = read_image(first.depth, kDepthImage).size();
  recording.sensor.ir = depth.of_mode(mode_of(kDepthModes, size, first.depth), "depth", recording.notes);
  recording.calibrated = true;
  if (first.color.empty()) return;
  const RawCamera color = camera_at(file, "PV0");
  const cv::Size color_size = read_image(first.color, kColorOrGreyImage).size();
  recording.sensor.color = color.of_mode(mode_of(kColorModes, color_size, first.color), "colour", recording.notes);
  recording.sensor.color_from_ir = color.extrinsics() * depth.extrinsics().inverse();
  if (const auto found = problem_with(recording.sensor))
    file.at("CalibrationInformation").fail(found->field + ": " + found->problem);
}

fs::path stream_folder(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (fs::is_directory(folder / name)) return folder / name;
  return {};
}

// Partners of every depth frame in another stream; the stream is left out where there is no folder.
void add_stream(Recording& recording, const std::vector<StampedFile>& depth, bool timed, const fs::path& folder,
                const AzureKinectParams& params, fs::path RecordedFrame::*image) {
  if (folder.empty()) return;
  const NumberedFiles stream = numbered_files(folder);
  const double tolerance_s = timed && stream.timed ? 1e-3 * params.tolerance_ms : 0;
  std::map<fs::path, const RecordedFrame*> by_depth;  // those that the streams before left
  for (const auto& frame : recording.frames) by_depth.emplace(frame.depth, &frame);
  std::vector<RecordedFrame> kept;
  for (const auto& [a, b] : associate(depth, stream.files, tolerance_s)) {
    const auto frame = by_depth.find(depth[a].path);
    if (frame == by_depth.end()) continue;
    kept.push_back(*frame->second);
    kept.back().*image = stream.files[b].path;
  }
  if (2 * kept.size() < recording.frames.size())
    throw InputError(folder.string(), fmt::format("found partners for {} of {} depth frames; expected streams of one "
                                                  "recording, half of them at least",
                                                  kept.size(), recording.frames.size()));
  if (kept.size() < recording.frames.size())
    recording.notes.push_back(fmt::format("{} of {} depth frames left out: none beside it in {}",
                                          recording.frames.size() - kept.size(), recording.frames.size(),
                                          folder.filename().string()));
  recording.frames = std::move(kept);
}

Recording azure_kinect(const fs::path& folder, const RecordingUse& use, const AzureKinectParams& params) {
  Recording recording;
  recording.sensor.model = "azure_kinect";
  recording.no_depth = {65535, params.no_depth};
  const NumberedFiles depth = numbered_files(folder / "depth");
  if (depth.files.empty()) throw InputError((folder / "depth").string(), "found no images; expected depth frames");
  for (const auto& each : depth.files) recording.frames.push_back({{}, {}, each.path});
  if (use != RecordingUse::scan) {
    const fs::path color = stream_folder(folder, {"color", "rgb"}), ir = stream_folder(folder, {"ir", "infrared"});
    if (color.empty()) throw InputError((folder / "color").string(), "is missing; expected a folder of colour images");
    add_stream(recording, depth.files, depth.timed, color, params, &RecordedFrame::color);
    add_stream(recording, depth.files, depth.timed, ir, params, &RecordedFrame::ir);
  }
  read_calibration(folder, recording);
  return recording;
}

const Importer::Variant azure_kinect_variant{"azure_kinect", azure_kinect};

}  // namespace
}  // namespace dressform
