#include "pipeline/fuse/scan_frames.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "pipeline/imaging/sensor_noise.h"

namespace dressform {
namespace {

constexpr int kWidthForTracking = 256;
constexpr double kLeastValidPart = 0.01;  // of the pixels, for a frame to be used

// Bin of a unit vector on a cube map of 6 x 6 cells a face.
int direction_bin(const Vector3f& normal) {
  constexpr int kCells = 6;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const float scale = 1 / std::abs(normal[axis]);
  const auto cell = [&](float c) { return std::min(kCells - 1, static_cast<int>((c * scale + 1) / 2 * kCells)); };
  const int face = 2 * axis + (normal[axis] < 0 ? 1 : 0);
  return (face * kCells + cell(normal[(axis + 1) % 3])) * kCells + cell(normal[(axis + 2) % 3]);
}

std::vector<int> sample_directions(const DepthMap& map, int per_direction) {
  std::array<std::vector<int>, 216> bins;
  for (int i = 0; i < static_cast<int>(map.points.size()); ++i)
    if (map.has_normal(i)) bins[direction_bin(map.normals[i])].push_back(i);
  std::vector<int> result;
  for (const auto& bin : bins) {
    const int kept = std::min(per_direction, static_cast<int>(bin.size()));
    for (int k = 0; k < kept; ++k) result.push_back(bin[static_cast<std::size_t>(k) * bin.size() / kept]);
  }
  return result;
}

}  // namespace

const DepthMap& ScanFrames::first_usable() const {
  for (int i = 0; i < count(); ++i)
    if (usable[i]) return maps[i];
  throw std::logic_error("no usable frame");
}

ScanFrames prepare_frames(const DepthScan& scan, const SensorCalibration& calibration, int samples_per_direction,
                          double max_depth_m) {
  DepthMapOptions options;
  options.max_depth_m = max_depth_m;
  options.shrink = std::max(1, calibration.ir.width / kWidthForTracking);
  options.noise_factor = depth_noise_factor(frames_for_noise(scan.depth_mm), calibration.ir);
  const cv::Mat rays = normalized_grid(shrunken_camera(calibration.ir, options.shrink));
  const int count = static_cast<int>(scan.depth_mm.size());
  ScanFrames frames;
  frames.noise_factor = options.noise_factor;
  frames.depth_m.resize(count);
  frames.maps.resize(count);
  frames.samples.resize(count);
  frames.usable.assign(count, 0);
  tbb::parallel_for(0, count, [&](int i) {
    const cv::Mat depth_m = clean_depth(scan.depth_mm[i], calibration, options);
    DepthMap map = make_depth_map(depth_m, calibration.ir, rays, options);
    if (map.valid < kLeastValidPart * map.points.size()) return;
    frames.samples[i] = sample_directions(map, samples_per_direction);
    frames.depth_m[i] = depth_m;
    frames.maps[i] = std::move(map);
    frames.usable[i] = 1;
  });
  return frames;
}

}  // namespace dressform
