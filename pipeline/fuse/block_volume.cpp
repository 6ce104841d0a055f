#include "pipeline/fuse/block_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dressform {
namespace {

constexpr std::size_t kLeastFrames = 3;  // that saw something in a block
constexpr float kWithinBand = 0.95f;     // of the truncation: values at the band's end are no distances
constexpr float kLeastGradient = 0.2f;   // of a voxel's edge, from neighbour to neighbour: else there is no direction

}  // namespace

BlockVolume::BlockVolume(const ScanFrames& frames, const Camera& camera,
                         const std::vector<Isometry3d>& model_from_frame, const std::vector<char>& used,
                         const VolumeRegion& region, const VolumeOptions& options)
    : options_(options) {
  allocate(frames, model_from_frame, used, region);
  blocks_.resize(keys_.size());
  std::vector<FrameView> views(frames.count());
  tbb::parallel_for(0, frames.count(), [&](int i) {
    if (used[i] && frames.usable[i])
      views[i] =
          frame_view(frames.depth_m[i], frames.maps[i], camera, model_from_frame[i].inverse(), options.min_cosine);
  });
  const Projector projector(camera);
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
    const Vector3f origin =
        (VoxelBlock::block_of(keys_[b]) * kEdge).cast<float>() * static_cast<float>(options_.voxel_m);
    for (const FrameView& view : views)
      if (!view.observations.empty() && may_see(view, projector, camera, origin, static_cast<float>(options_.voxel_m)))
        integrate(view, projector, origin, options_, blocks_[b]);
  });
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
      for (const float t : {-1.0f, 0.0f, 1.0f})
        keys.push_back(VoxelBlock::key_of(VoxelBlock::block_at(point + t * reach * normal, block_m)));
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  });
  std::vector<std::uint64_t> all;
  for (const auto& keys : found) all.insert(all.end(), keys.begin(), keys.end());
  std::sort(all.begin(), all.end());
  for (std::size_t k = 0; k + kLeastFrames <= all.size(); ++k)  // what only a few frames claim is noise
    if (all[k] == all[k + kLeastFrames - 1] && (keys_.empty() || keys_.back() != all[k])) keys_.push_back(all[k]);
}

const VoxelBlock* BlockVolume::find(const Cell& block) const {
  const std::uint64_t key = VoxelBlock::key_of(block);
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  return found != keys_.end() && *found == key ? &blocks_[found - keys_.begin()] : nullptr;
}

bool BlockVolume::read(const Cell& voxel, int least_observations, float& distance) const {
  const Cell cell = VoxelBlock::block_of_voxel(voxel);
  const VoxelBlock* block = find(cell);
  if (!block) return false;
  const int k = VoxelBlock::index(voxel - cell * kEdge);
  distance = block->distance[k];
  return block->observations[k] >= least_observations;
}

bool BlockVolume::gradient(const Cell& voxel, Vector3f& result) const {
  for (int axis = 0; axis < 3; ++axis) {
    float low = 0, high = 0;
    if (!read(voxel - Cell::Unit(axis), 1, low) || !read(voxel + Cell::Unit(axis), 1, high)) return false;
    result[axis] = high - low;
  }
  return result.norm() > kLeastGradient * static_cast<float>(options_.voxel_m);
}

void BlockVolume::block_points(std::size_t b, int least_observations, PointCloud& cloud) const {
  const Cell origin = VoxelBlock::block_of(keys_[b]) * kEdge;
  const auto voxel_m = static_cast<float>(options_.voxel_m);
  const auto inside_band = [&](float d) {
    return std::abs(d) < kWithinBand * static_cast<float>(options_.truncation_m);
  };
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
