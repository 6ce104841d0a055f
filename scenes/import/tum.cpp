#include "scenes/error.h"
#include "scenes/import/import.h"
#include "scenes/import/recorded_poses.h"
#include "scenes/import/stamped_files.h"

// Recordings of the RGB-D benchmark: Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012.
// depth.txt and rgb.txt list stamps (seconds) and images; depth is 16-bit, 5000 a metre, on colour's grid;
// groundtruth.txt, where there is one, the camera's poses by motion capture.
namespace dressform {
namespace {

namespace fs = std::filesystem;

struct TumParams : StreamParams {
  TumParams() { depth_per_m = 5000; }  // 65535 is 13.1 m: beyond any of its sensors, and what saturates to it
};

// The benchmark's Kinect v1 and Xtion see nothing nearer.
constexpr double kNearest_m = 0.45;
// Its motion capture takes 100 poses a second: longer than a few of them, the camera was not seen.
constexpr double kLongestGap_s = 0.05;

Recording tum(const fs::path& folder, const RecordingUse& use, const TumParams& params) {
  if (use == RecordingUse::boards) fail_without_infrared(folder);
  Recording recording;
  recording.sensor.model = "kinect_v1";
  recording.prime_sense = true;
  recording.range.nearest_m = kNearest_m;
  set_stream(recording, params);
  const auto depth = listed_files(folder, "depth.txt");
  const fs::path truth = folder / "groundtruth.txt";
  const auto poses = fs::exists(truth) ? stamped_poses(truth) : std::vector<StampedPose>{};
  if (fs::exists(folder / "rgb.txt") || use == RecordingUse::shot) {
    for (const auto& [each, color] : with_partners(depth, listed_files(folder, "rgb.txt"), 1e-3 * params.tolerance_ms,
                                                   (folder / "depth.txt").string(), recording.notes))
      recording.frames.push_back({color.path, {}, each.path, 0, pose_at(poses, each.stamp_s, kLongestGap_s)});
  } else {
    for (const auto& each : depth)
      recording.frames.push_back({{}, {}, each.path, 0, pose_at(poses, each.stamp_s, kLongestGap_s)});
    recording.notes.push_back("no rgb.txt: synchronisation with colour was not checked");
  }
  return recording;
}

const Importer::Variant tum_variant{"tum", tum};

}  // namespace
}  // namespace dressform
