#include <fmt/format.h>

#include <map>
#include <regex>

#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/import/import.h"
#include "scenes/import/opencv_yaml.h"
#include "scenes/import/rational_lens.h"
#include "scenes/session_limits.h"

// Folders of iai_kinect2 (Wiedemeyer, University of Bremen, 2014-2015): shots NNNN_sync_color.png, NNNN_sync_ir.png,
// NNNN_sync_depth.png of kinect2_calibration, and its results calib_color.yaml, calib_ir.yaml, calib_pose.yaml (colour
// from infrared, metres) and calib_depth.yaml (millimetres to add to measured depth). kinect2_calibration also takes
// colour (NNNN_color.png) and infrared (NNNN_ir.png, NNNN_depth.png) by themselves, at different times. kinect2_viewer
// saves NNNN_color.jpg and NNNN_depth.png, rectified, shifted, and with "qhd" or "hd" on colour's grid.
namespace dressform {
namespace {

namespace fs = std::filesystem;

struct IaiKinect2Params {
  bool separate = false;
  int no_depth = 65535;
};

template <class V>
void fields(V& v, IaiKinect2Params& p) {
  v("separate", p.separate, "take NNNN_color.png, NNNN_ir.png and NNNN_depth.png of one number for one moment");
  v("no_depth", p.no_depth, 0, 65535, "", "value of depth images that means none, besides 0 and 65535");
}

struct FoundFrames {
  std::map<long, RecordedFrame> synchronised, separate;  // by number
};

FoundFrames find_frames(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "is missing; expected the folder of a recording");
  static const std::regex form("([0-9]{1,9})(_sync)?_(color|ir|depth)\\.(png|jpg)");
  FoundFrames found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::smatch parts;
    const std::string name = entry.path().filename().string();
    if (!std::regex_match(name, parts, form)) continue;
    RecordedFrame& frame = (parts[2].matched ? found.synchronised : found.separate)[std::stol(parts[1])];
    fs::path& path = parts[3] == "color" ? frame.color : parts[3] == "ir" ? frame.ir : frame.depth;
    if (!path.empty())
      throw InputError(entry.path().string(),
                       "found another image of the same number, " + path.filename().string() + "; expected one");
    path = entry.path();
  }
  return found;
}

void check_whole(const fs::path& folder, long number, bool synchronised, const RecordedFrame& frame) {
  for (const auto& [path, what] : {std::pair(&frame.color, "color"), {&frame.ir, "ir"}, {&frame.depth, "depth"}})
    if (path->empty())
      throw InputError((folder / fmt::format("{:04d}{}_{}.png", number, synchronised ? "_sync" : "", what)).string(),
                       "is missing; expected color, ir and depth of every shot");
}

std::vector<RecordedFrame> frames_for(const fs::path& folder, const RecordingUse& use, bool separate,
                                      std::vector<std::string>& notes) {
  const FoundFrames found = find_frames(folder);
  if (found.synchronised.empty() && found.separate.empty())
    throw InputError(folder.string(),
                     "found no recorded images; expected NNNN_sync_color.png, NNNN_sync_ir.png and "
                     "NNNN_sync_depth.png");
  if (use == RecordingUse::scan) separate = found.synchronised.empty();  // depth alone needs no partner in time
  if (!separate && found.synchronised.empty())
    throw InputError(folder.string(),
                     "found colour and infrared of different moments only; expected synchronised "
                     "NNNN_sync_*.png, or --set import.separate=true where nothing moved between");
  const auto& chosen = separate ? found.separate : found.synchronised;
  if (const std::size_t left = (separate ? found.synchronised : found.separate).size(); left > 0)
    notes.push_back(fmt::format("{} shots left out: {}", left,
                                separate ? "synchronised ones" : "colour or infrared by itself, not synchronised"));
  std::vector<RecordedFrame> frames;
  for (const auto& [number, frame] : chosen) {
    if (use != RecordingUse::scan) check_whole(folder, number, !separate, frame);
    if (!frame.depth.empty()) frames.push_back(frame);
  }
  if (frames.empty()) throw InputError(folder.string(), "found no depth images; expected NNNN_depth.png");
  return frames;
}

// A camera whose file has OpenCV's rational lens: the polynomial one that comes nearest over the image.
Camera without_rational_lens(const fs::path& file, const OpenCvYaml& yaml, const Camera& camera, const cv::Mat& d,
                             std::vector<std::string>& notes) {
  constexpr double kWorstLens_px = 1;  // root mean square over the image: corners are found to a tenth of it
  constexpr double kFarthest = 3;      // radius at focal length 1: 72 degrees off the axis, farther than these see
  const auto at = [&](int i) { return d.at<double>(i); };
  const auto fit = with_polynomial_lens(camera, {{at(0), at(1), at(4), at(5), at(6), at(7)}, at(2), at(3)}, kFarthest);
  if (!(fit.rms_px <= kWorstLens_px))
    yaml.fail("distortionCoefficients",
              fmt::format("found a rational lens of {} coefficients that the five of a session miss by {:.1f} px; "
                          "expected at most {:g} px (calibrate with five)",
                          d.total(), fit.rms_px, kWorstLens_px));
  notes.push_back(fmt::format("{}: eight coefficients of the lens became five, off by {:.2f} px rms, {:.2f} px at most",
                              file.filename().string(), fit.rms_px, fit.worst_px));
  return fit.camera;
}

enum class Images { raw, rectified };

// Camera of images of this size; of rectified ones without a lens.
Camera read_camera(const fs::path& file, cv::Size size, Images images, std::vector<std::string>& notes) {
  const OpenCvYaml yaml(file);
  const cv::Mat k = yaml.matrix("cameraMatrix", 3, 3), d = yaml.matrix("distortionCoefficients", 0, 0);
  Camera camera{size.width,         size.height, k.at<double>(0, 0), k.at<double>(1, 1), k.at<double>(0, 2),
                k.at<double>(1, 2), {}};
  if (std::abs(camera.cx / size.width - 0.5) > 0.15 || std::abs(camera.cy / size.height - 0.5) > 0.15)
    yaml.fail("cameraMatrix",
              fmt::format("found a principal point of {:.0f}, {:.0f} for images of {} x {}; expected the "
                          "camera of images of this size",
                          camera.cx, camera.cy, size.width, size.height));
  const int coefficients = static_cast<int>(d.total());
  if (std::min(d.rows, d.cols) != 1 || coefficients < 4)
    yaml.fail("distortionCoefficients", "found a matrix; expected a row of 5 numbers");
  bool rational = false;
  for (int i = 0; i < coefficients; ++i) {
    if (i < 5 && images == Images::raw) camera.distortion[i] = d.at<double>(i);
    if (i >= 5 && d.at<double>(i) != 0) rational = true;
    if (i >= 8 && d.at<double>(i) != 0)
      yaml.fail("distortionCoefficients",
                fmt::format("found {} coefficients, and not 0 those of a thin prism or a tilted sensor; expected 5, or "
                            "8 of the rational model",
                            coefficients));
  }
  if (rational && coefficients < 8)
    yaml.fail("distortionCoefficients", fmt::format("found {} coefficients; expected 4, 5 or 8", coefficients));
  if (const auto found = problem_with(camera))
    yaml.fail(found->field == "distortion" ? "distortionCoefficients" : "cameraMatrix",
              found->field + ": " + found->problem);
  return rational && images == Images::raw ? without_rational_lens(file, yaml, camera, d, notes) : camera;
}

Isometry3d read_step(const fs::path& file) {
  const OpenCvYaml yaml(file);
  const cv::Mat rotation = yaml.matrix("rotation", 3, 3), translation = yaml.matrix("translation", 3, 1);
  auto rows = nlohmann::json::array();
  for (int y = 0; y < 3; ++y)
    rows.push_back(
        {rotation.at<double>(y, 0), rotation.at<double>(y, 1), rotation.at<double>(y, 2), translation.at<double>(y)});
  rows.push_back({0, 0, 0, 1});
  return JsonValue(file.string() + ": rotation", rows).rigid();
}

// Depth as kinect2_viewer saves it: the offset is off, and so is the distortion.
void read_rectified_calibration(const fs::path& folder, Recording& recording) {
  constexpr int color_width = 1920, color_height = 1080;
  const cv::Size size = read_image(recording.frames.front().depth, kDepthImage).size();
  const bool on_color = size.width * color_height == size.height * color_width;
  const fs::path file = folder / (on_color ? "calib_color.yaml" : "calib_ir.yaml");
  if (!fs::exists(file)) return;
  Camera& camera = recording.sensor.ir;
  if (on_color) {  // its matrix divided by the scale, as kinect2_bridge does
    const double scale = static_cast<double>(size.width) / color_width;
    camera = read_camera(file, {color_width, color_height}, Images::rectified, recording.notes);
    camera.width = size.width, camera.height = size.height;
    camera.fx *= scale, camera.fy *= scale, camera.cx *= scale, camera.cy *= scale;
  } else {
    camera = read_camera(file, size, Images::rectified, recording.notes);
  }
  recording.calibrated = true;
  recording.notes.push_back("images of kinect2_viewer: rectified and shifted by it");
}

void read_calibration(const fs::path& folder, const RecordingUse& use, Recording& recording) {
  const RecordedFrame& first = recording.frames.front();
  if (use == RecordingUse::scan && first.color.extension() == ".jpg")
    return read_rectified_calibration(folder, recording);
  const auto has = [&](const char* name) { return fs::exists(folder / name); };
  if (use == RecordingUse::boards) {
    if (!has("calib_color.yaml") || !has("calib_ir.yaml") || !has("calib_pose.yaml")) {
      recording.notes.push_back("no calib_color.yaml, calib_ir.yaml and calib_pose.yaml: calibrate from the boards");
      return;
    }
  } else if (!has("calib_ir.yaml")) {
    return;
  }
  recording.sensor.ir =
      read_camera(folder / "calib_ir.yaml", read_image(first.depth, kDepthImage).size(), Images::raw, recording.notes);
  if (use != RecordingUse::scan) {
    const cv::Size size = read_image(first.color, kColorOrGreyImage).size();
    recording.sensor.color = read_camera(folder / "calib_color.yaml", size, Images::raw, recording.notes);
    recording.sensor.color_from_ir = read_step(folder / "calib_pose.yaml");
    if (const auto found = problem_with(recording.sensor))
      throw InputError((folder / "calib_pose.yaml").string() + ": translation", found->problem);
  }
  if (has("calib_depth.yaml")) {
    const OpenCvYaml yaml(folder / "calib_depth.yaml");
    const double shift_mm = yaml.number("depthShift");
    recording.sensor.depth_offset_m = -1e-3 * shift_mm;
    if (const auto found = problem_with(recording.sensor))
      yaml.fail("depthShift", found->problem + " (the file has millimetres)");
  } else {
    recording.notes.push_back("no calib_depth.yaml: depth is taken to have no offset");
  }
  recording.calibrated = true;
}

Recording iai_kinect2(const fs::path& folder, const RecordingUse& use, const IaiKinect2Params& params) {
  Recording recording;
  recording.sensor.model = "kinect_v2";
  recording.no_depth = {65535, params.no_depth};
  recording.frames = frames_for(folder, use, params.separate, recording.notes);
  read_calibration(folder, use, recording);
  return recording;
}

const Importer::Variant iai_kinect2_variant{"iai_kinect2", iai_kinect2};

}  // namespace
}  // namespace dressform
