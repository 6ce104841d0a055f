#include <fmt/format.h>

#include "scenes/error.h"
#include "scenes/image_file.h"
#include "scenes/import/import.h"
#include "scenes/import/recorded_poses.h"
#include "scenes/import/stamped_files.h"
#include "scenes/json_file.h"
#include "scenes/session_limits.h"

// A scene of the BOP benchmark's layout (Hodan et al., "BOP: benchmark for 6D object pose estimation", ECCV 2018):
// depth/NNNNNN.png (16-bit, depth_scale millimetres a step), rgb/NNNNNN.png or .jpg on the same grid, and
// scene_camera.json with cam_K (row by row) and depth_scale of every image.
namespace dressform {
namespace {

namespace fs = std::filesystem;

struct BopParams {
  int no_depth = 65535;
};
template <class V>
void fields(V& v, BopParams& p) {
  v("no_depth", p.no_depth, 0, 65535, "", "value of depth images that means none, besides 0 and 65535");
}

struct BopCamera {
  Camera camera;
  double depth_per_m = 1000;
};

// Size 0 x 0: the file does not know it.
BopCamera read_camera(const JsonValue& entry) {
  const JsonValue matrix = entry.at("cam_K");
  const auto k = matrix.numbers(9);
  if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1)
    matrix.fail("found no camera matrix; expected [fx, 0, cx, 0, fy, cy, 0, 0, 1]");
  BopCamera result;
  result.camera.fx = k[0], result.camera.fy = k[4], result.camera.cx = k[2], result.camera.cy = k[5];
  const JsonValue scale = entry.at("depth_scale");
  if (!(scale.number() > 0.001 && scale.number() <= 1000))
    scale.fail(fmt::format("found {:g}; expected millimetres a step of depth, 0.001 to 1000", scale.number()));
  result.depth_per_m = 1000 / scale.number();
  return result;
}

// Rows of the rotation; millimetres.
std::optional<Isometry3d> read_pose(const JsonValue& entry) {
  if (!entry.has("cam_R_w2c") || !entry.has("cam_t_w2c")) return {};
  const JsonValue rotation = entry.at("cam_R_w2c");
  const auto r = rotation.numbers(9), t = entry.at("cam_t_w2c").numbers(3);
  const Eigen::Matrix3d rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(r.data());
  return rigid_motion(rotation.where(), rows, 1e-3 * Vector3d(t[0], t[1], t[2])).inverse();
}

bool same_lens(const Camera& a, const Camera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

std::vector<DepthAndColor> images_of(const fs::path& folder, const RecordingUse& use, std::vector<std::string>& notes) {
  const auto depth = numbered_files(folder / "depth").files;
  if (depth.empty()) throw InputError((folder / "depth").string(), "found no images; expected depth frames");
  if (fs::exists(folder / "rgb"))
    return with_partners(depth, numbered_files(folder / "rgb").files, 0, (folder / "depth").string(), notes);
  if (use == RecordingUse::shot)
    throw InputError((folder / "rgb").string(), "is missing; expected a folder of colour, which a shot needs");
  std::vector<DepthAndColor> frames;
  for (const auto& each : depth) frames.push_back({each, {}});
  return frames;
}

Recording bop(const fs::path& folder, const RecordingUse& use, const BopParams& params) {
  if (use == RecordingUse::boards) fail_without_infrared(folder);
  Recording recording;
  recording.sensor.model = "unknown";  // many sensors' recordings have this layout
  recording.on_color_grid = recording.calibrated = true;
  recording.no_depth = {65535, params.no_depth};
  const JsonValue cameras = read_json(folder / "scene_camera.json");
  std::optional<Camera> first;
  for (const auto& [depth, color] : images_of(folder, use, recording.notes)) {
    const JsonValue entry = cameras.at(std::to_string(static_cast<long>(depth.stamp_s)));
    const BopCamera camera = read_camera(entry);
    if (first && !same_lens(*first, camera.camera))
      entry.at("cam_K").fail(
          "found another camera than that of the first image; expected one camera, which does not "
          "zoom or crop, in a recording");
    if (!first) first = camera.camera, recording.depth_per_m = camera.depth_per_m;
    recording.frames.push_back({color.path, {}, depth.path, camera.depth_per_m, read_pose(entry)});
  }
  recording.sensor.ir = *first;
  const cv::Size size = read_image(recording.frames.front().depth, kDepthImage).size();
  recording.sensor.ir.width = size.width, recording.sensor.ir.height = size.height;
  if (const auto found = problem_with(recording.sensor.ir))
    cameras.fail("cam_K: " + found->field + ": " + found->problem);
  return recording;
}

const Importer::Variant bop_variant{"bop", bop};

}  // namespace
}  // namespace dressform
