#include "pipeline/fuse/block_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dressform {
namespace {

constexpr int kKeyBits = 21, kKeyOffset = 1 << 20;

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

// What one frame says about one point.
struct Observation {
  float distance_m = 0;  // to the plane seen, positive towards the sensor
  float weight = 0;
};

// Depth at a sub-pixel place: bilinear where the four pixels hold one surface, else the nearest pixel's; 0 for none.
float depth_at(const cv::Mat& depth_m, const Vector2f& pixel, float largest_step) {
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  if (x >= 0 && y >= 0 && x + 1 < depth_m.cols && y + 1 < depth_m.rows) {
    const float *top = depth_m.ptr<float>(y) + x, *bottom = depth_m.ptr<float>(y + 1) + x;
    const float low = std::min(std::min(top[0], top[1]), std::min(bottom[0], bottom[1]));
    const float high = std::max(std::max(top[0], top[1]), std::max(bottom[0], bottom[1]));
    if (low > 0 && high - low < largest_step) {
      const float a = pixel.x() - x, b = pixel.y() - y;
      return (top[0] * (1 - a) + top[1] * a) * (1 - b) + (bottom[0] * (1 - a) + bottom[1] * a) * b;
    }
  }
  const int u = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, depth_m.cols - 1);
  const int v = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, depth_m.rows - 1);
  return depth_m.at<float>(v, u);
}

// Index into the shrunken map under a pixel of the full image.
int map_index(const DepthMap& map, const Vector2f& pixel, const Camera& camera) {
  const int shrink = camera.width / map.camera.width;
  const int x = std::clamp(static_cast<int>(pixel.x() + 0.5f) / shrink, 0, map.camera.width - 1);
  const int y = std::clamp(static_cast<int>(pixel.y() + 0.5f) / shrink, 0, map.camera.height - 1);
  return y * map.camera.width + x;
}

bool observe(const cv::Mat& depth_m, const DepthMap& map, const Camera& camera, const Projector& projector,
             const Vector3f& point, const VolumeOptions& options, Observation& observation) {
  Vector2f pixel;
  if (!projector(point, pixel)) return false;
  const int index = map_index(map, pixel, camera);
  if (!map.has_normal(index)) return false;
  const float depth = depth_at(depth_m, pixel, 0.03f);
  if (depth == 0) return false;
  const Vector3f ray = point / point.z(), &normal = map.normals[index];
  const float along = -normal.dot(ray), cosine = along / ray.norm();
  if (cosine < options.min_cosine) return false;
  observation.distance_m = (depth - point.z()) * along;
  if (observation.distance_m < -options.truncation_m) return false;
  const float sigma_mm = 1e3f * map.sigma_m[index];
  observation.weight = cosine * cosine / (sigma_mm * sigma_mm);
  return true;
}

}  // namespace

std::uint64_t BlockVolume::key_of(const Cell& block) {
  const auto part = [](int c) { return static_cast<std::uint64_t>(c + kKeyOffset); };
  return (part(block.x()) << (2 * kKeyBits)) | (part(block.y()) << kKeyBits) | part(block.z());
}

BlockVolume::Cell BlockVolume::block_of(std::uint64_t key) {
  const auto part = [](std::uint64_t c) { return static_cast<int>(c & ((1u << kKeyBits) - 1)) - kKeyOffset; };
  return {part(key >> (2 * kKeyBits)), part(key >> kKeyBits), part(key)};
}

BlockVolume::BlockVolume(const ScanFrames& frames, const Camera& camera,
                         const std::vector<Isometry3d>& model_from_frame, const std::vector<char>& used,
                         const VolumeRegion& region, const VolumeOptions& options)
    : options_(options) {
  allocate(frames, model_from_frame, used, region);
  blocks_.resize(keys_.size());
  std::vector<Isometry3d> frame_from_model;
  for (const auto& pose : model_from_frame) frame_from_model.push_back(pose.inverse());
  const Projector projector(camera);
  tbb::parallel_for(std::size_t{0}, blocks_.size(),
                    [&](std::size_t b) { integrate(b, frames, camera, projector, frame_from_model, used); });
}

void BlockVolume::allocate(const ScanFrames& frames, const std::vector<Isometry3d>& model_from_frame,
                           const std::vector<char>& used, const VolumeRegion& region) {
  std::vector<std::vector<std::uint64_t>> found(frames.count());
  const auto block_m = static_cast<float>(kEdge * options_.voxel_m);
  const auto reach = static_cast<float>(options_.truncation_m);
  tbb::parallel_for(0, frames.count(), [&](int i) {
    if (!used[i] || !frames.usable[i]) return;
    const DepthMap& map = frames.maps[i];
    auto& keys = found[i];
    for (std::size_t k = 0; k < map.points.size(); ++k) {
      if (!map.has_normal(static_cast<int>(k))) continue;
      const Vector3f point = (model_from_frame[i] * map.points[k].cast<double>()).cast<float>();
      if (!region.contains(point)) continue;
      const Vector3f normal = (model_from_frame[i].linear() * map.normals[k].cast<double>()).cast<float>();
      for (const float t : {-1.0f, 0.0f, 1.0f}) {
        const Vector3f at = (point + t * reach * normal) / block_m;
        const Cell block(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                         static_cast<int>(std::floor(at.z())));
        keys.push_back(key_of(block));
      }
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  });
  for (const auto& keys : found) keys_.insert(keys_.end(), keys.begin(), keys.end());
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
}

void BlockVolume::integrate(std::size_t b, const ScanFrames& frames, const Camera& camera, const Projector& projector,
                            const std::vector<Isometry3d>& frame_from_model, const std::vector<char>& used) {
  Block& block = blocks_[b];
  std::fill(std::begin(block.distance), std::end(block.distance), 0.0f);
  std::fill(std::begin(block.weight), std::end(block.weight), 0.0f);
  std::fill(std::begin(block.observations), std::end(block.observations), std::uint16_t{0});
  const auto voxel_m = static_cast<float>(options_.voxel_m), truncation_m = static_cast<float>(options_.truncation_m);
  const Vector3f origin = (block_of(keys_[b]) * kEdge).cast<float>() * voxel_m;
  const Vector3f middle = origin + Vector3f::Constant(0.5f * (kEdge - 1) * voxel_m);
  const float radius = 0.87f * kEdge * voxel_m;
  for (int i = 0; i < frames.count(); ++i) {
    if (!used[i] || !frames.usable[i]) continue;
    const Eigen::Matrix3f rotation = frame_from_model[i].linear().cast<float>();
    const Vector3f translation = frame_from_model[i].translation().cast<float>();
    // A block wholly hidden behind what is seen in its direction is passed over at once.
    const Vector3f centre = rotation * middle + translation;
    Vector2f pixel;
    if (!projector(centre, pixel) && centre.z() < radius) continue;
    const Vector3f step_x = rotation.col(0) * voxel_m, step_y = rotation.col(1) * voxel_m;
    const Vector3f step_z = rotation.col(2) * voxel_m, first = rotation * origin + translation;
    for (int z = 0, k = 0; z < kEdge; ++z)
      for (int y = 0; y < kEdge; ++y)
        for (int x = 0; x < kEdge; ++x, ++k) {
          const Vector3f point = first + x * step_x + y * step_y + z * step_z;
          Observation seen;
          if (!observe(frames.depth_m[i], frames.maps[i], camera, projector, point, options_, seen)) continue;
          const float distance = std::min(seen.distance_m, truncation_m), sum = block.weight[k] + seen.weight;
          block.distance[k] += (distance - block.distance[k]) * (seen.weight / sum);
          block.weight[k] = sum;
          ++block.observations[k];
        }
  }
}

const BlockVolume::Block* BlockVolume::find(const Cell& block) const {
  const std::uint64_t key = key_of(block);
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  return found != keys_.end() && *found == key ? &blocks_[found - keys_.begin()] : nullptr;
}

bool BlockVolume::read(const Cell& voxel, int least_observations, float& distance) const {
  const Cell cell(floor_div(voxel.x(), kEdge), floor_div(voxel.y(), kEdge), floor_div(voxel.z(), kEdge));
  const Block* block = find(cell);
  if (!block) return false;
  const Cell local = voxel - cell * kEdge;
  const int k = (local.z() * kEdge + local.y()) * kEdge + local.x();
  distance = block->distance[k];
  return block->observations[k] >= least_observations;
}

bool BlockVolume::gradient(const Cell& voxel, Vector3f& result) const {
  for (int axis = 0; axis < 3; ++axis) {
    float low = 0, high = 0;
    if (!read(voxel - Cell::Unit(axis), 1, low) || !read(voxel + Cell::Unit(axis), 1, high)) return false;
    result[axis] = high - low;
  }
  return result.norm() > 0.2f * static_cast<float>(options_.voxel_m);
}

void BlockVolume::block_points(std::size_t b, int least_observations, PointCloud& cloud) const {
  const Cell origin = block_of(keys_[b]) * kEdge;
  const auto voxel_m = static_cast<float>(options_.voxel_m);
  const auto inside_band = [&](float d) { return std::abs(d) < 0.95f * static_cast<float>(options_.truncation_m); };
  for (int k = 0; k < kVoxels; ++k) {
    const Cell voxel = origin + Cell(k % kEdge, (k / kEdge) % kEdge, k / (kEdge * kEdge));
    const float here = blocks_[b].distance[k];
    if (blocks_[b].observations[k] < least_observations || !inside_band(here)) continue;
    Vector3f point = Vector3f::Zero(), normal = Vector3f::Zero();
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis) {
      float there = 0;
      if (!read(voxel + Cell::Unit(axis), least_observations, there) || !inside_band(there)) continue;
      if ((here < 0) == (there < 0)) continue;
      Vector3f slope, other;
      if (!gradient(voxel, slope) || !gradient(voxel + Cell::Unit(axis), other)) continue;
      const float part = here / (here - there);
      point += (voxel.cast<float>() + part * Vector3f::Unit(axis)) * voxel_m;
      normal += ((1 - part) * slope + part * other).normalized();
      ++crossings;
    }
    if (crossings == 0 || normal.norm() < 1e-3f) continue;
    cloud.points.push_back((point / crossings).cast<double>());
    cloud.normals.push_back(normal.normalized().cast<double>());
  }
}

PointCloud BlockVolume::surface_points(int least_observations) const {
  constexpr std::size_t kChunk = 64;
  std::vector<PointCloud> parts((keys_.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t c) {
    for (std::size_t b = c * kChunk; b < std::min(keys_.size(), (c + 1) * kChunk); ++b)
      block_points(b, least_observations, parts[c]);
  });
  PointCloud cloud;
  for (const auto& part : parts) {
    cloud.points.insert(cloud.points.end(), part.points.begin(), part.points.end());
    cloud.normals.insert(cloud.normals.end(), part.normals.begin(), part.normals.end());
  }
  return cloud;
}

}  // namespace dressform
