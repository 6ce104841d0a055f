#include "pipeline/fuse/model_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr int kEdge = VoxelBlock::kEdge;
constexpr int kStride = 3;              // pixels from which blocks are made: they are many times wider than a pixel
constexpr int kTile = 8;                // pixels of an image whose rays start and end at one depth
constexpr float kHalfDiagonal = 0.87f;  // of a cube, in edges: sqrt(3) / 2, rounded up
constexpr float kNearest_m = 0.2f;      // from the sensor, where rays start
constexpr float kClose = 0.3f;  // of a voxel: so near to the surface is on it; from a part of that on nothing is gained
constexpr float kLeastSlope = 0.2f;      // of the distance along a ray: less is no surface, or grazed
constexpr float kLeastCosine = 0.2f;     // between normal and line of sight
constexpr float kLeastSigma_m = 0.001f;  // of the model: what its voxels blur

}  // namespace

ModelVolume::ModelVolume(const Camera& ir, const VolumeOptions& options)
    : ir_(ir),
      projector_(ir),
      options_(options),
      voxel_m_(static_cast<float>(options.voxel_m)),
      block_m_(static_cast<float>(kEdge * options.voxel_m)) {}

void ModelVolume::allocate(const DepthMap& map, const Isometry3d& world_from_frame) {
  const Eigen::Matrix3f rotation = world_from_frame.linear().cast<float>();
  const Vector3f translation = world_from_frame.translation().cast<float>();
  const auto reach = static_cast<float>(options_.truncation_m);
  std::vector<std::uint64_t> keys;
  for (int y = 0; y < map.camera.height; y += kStride)
    for (int x = 0; x < map.camera.width; x += kStride) {
      const int k = y * map.camera.width + x;
      if (!map.has_normal(k)) continue;
      const Vector3f point = rotation * map.points[k] + translation, normal = rotation * map.normals[k];
      for (const float t : {-1.0f, 0.0f, 1.0f})
        keys.push_back(VoxelBlock::key_of(VoxelBlock::block_at(point + t * reach * normal, block_m_)));
    }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const std::uint64_t key : keys) {
    if (!index_.emplace(key, static_cast<int>(blocks_.size())).second) continue;
    cells_.push_back(VoxelBlock::block_of(key));
    blocks_.emplace_back();
  }
}

void ModelVolume::integrate(const cv::Mat& depth_m, const DepthMap& map, const Isometry3d& world_from_frame) {
  allocate(map, world_from_frame);
  const FrameView view = frame_view(depth_m, map, ir_, world_from_frame.inverse(), options_.min_cosine);
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
    const Vector3f origin = (cells_[b] * kEdge).cast<float>() * voxel_m_;
    if (may_see(view, projector_, ir_, origin, voxel_m_))
      dressform::integrate(view, projector_, origin, options_, blocks_[b]);
  });
}

const VoxelBlock* ModelVolume::block_in(Cursor& cursor, const Cell& cell) const {
  if (cell == cursor.cell) return cursor.block;
  const auto found = index_.find(VoxelBlock::key_of(cell));
  cursor.cell = cell;
  cursor.block = found == index_.end() ? nullptr : &blocks_[found->second];
  return cursor.block;
}

// Trilinear between the eight voxels round a point; false where one of them was never seen.
bool ModelVolume::interpolated(Cursor& cursor, const Vector3f& point, Sample& sample) const {
  const Vector3f at = point / voxel_m_;
  const Cell first(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                   static_cast<int>(std::floor(at.z())));
  const Vector3f part = at - first.cast<float>();
  sample = {};
  for (int corner = 0; corner < 8; ++corner) {
    const Cell step(corner & 1, corner >> 1 & 1, corner >> 2), voxel = first + step;
    const Cell cell = VoxelBlock::block_of_voxel(voxel);
    const VoxelBlock* block = block_in(cursor, cell);
    if (!block) return false;
    const int k = VoxelBlock::index(voxel - cell * kEdge);
    if (block->observations[k] == 0) return false;
    Vector3f share, sign;
    for (int axis = 0; axis < 3; ++axis) {
      share[axis] = step[axis] ? part[axis] : 1 - part[axis];
      sign[axis] = step[axis] ? 1.0f : -1.0f;
    }
    const float distance = block->distance[k];
    sample.distance += share.prod() * distance;
    sample.weight += share.prod() * block->weight[k];
    sample.gradient += distance * Vector3f(sign.x() * share.y() * share.z(), share.x() * sign.y() * share.z(),
                                           share.x() * share.y() * sign.z());
  }
  sample.gradient /= voxel_m_;
  return true;
}

// How far along the ray the cell's end is.
float ModelVolume::to_exit(const Cell& cell, const Vector3f& point, const Vector3f& ray) const {
  float least = block_m_;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(ray[axis]) < 1e-6f) continue;
    const float wall = block_m_ * static_cast<float>(cell[axis] + (ray[axis] > 0 ? 1 : 0));
    least = std::min(least, (wall - point[axis]) / ray[axis]);
  }
  return std::max(least, 0.0f) + 0.1f * voxel_m_;
}

// From near the surface onto it, by Newton's steps along the ray; false where the surface ends, faces away or is
// grazed.
bool ModelVolume::onto_surface(Cursor& cursor, const Vector3f& origin, const Vector3f& ray, float& depth,
                               Sample& sample) const {
  constexpr int kSteps = 3;
  const float close = kClose * voxel_m_;
  for (int step = 0; step < kSteps; ++step) {
    if (!interpolated(cursor, origin + depth * ray, sample)) return false;
    if (std::abs(sample.distance) < kClose * close) return true;
    const float slope = sample.gradient.dot(ray);
    if (slope > -kLeastSlope) return false;
    depth -= std::clamp(sample.distance / slope, -voxel_m_, voxel_m_);
  }
  return interpolated(cursor, origin + depth * ray, sample) && std::abs(sample.distance) < close;
}

// Marches along a ray (of unit z in the sensor's frame, so that steps are in depth) to where the distance changes from
// outside to inside.
bool ModelVolume::hit(const Vector3f& origin, const Vector3f& ray, const Range& range, float& depth,
                      Sample& sample) const {
  const float per_metre = 1 / ray.norm();
  Cursor cursor;
  float outside = -1, outside_distance = 0;  // depth of the last voxel seen outside, and its distance
  for (float s = std::max(range.near, kNearest_m); s < range.far;) {
    const Vector3f point = origin + s * ray;
    const Cell cell = VoxelBlock::block_at(point, block_m_);
    const VoxelBlock* block = block_in(cursor, cell);
    if (!block) {
      outside = -1;
      s += to_exit(cell, point, ray);
      continue;
    }
    const Vector3f at = point / voxel_m_ - (cell * kEdge).cast<float>();
    const auto nearest = [](float c) { return std::clamp(static_cast<int>(c + 0.5f), 0, kEdge - 1); };
    const int k = VoxelBlock::index({nearest(at.x()), nearest(at.y()), nearest(at.z())});
    const float distance = block->distance[k];
    if (block->observations[k] == 0) {
      outside = -1;
      s += voxel_m_ * per_metre;
    } else if (distance > 0) {
      outside = s;
      outside_distance = distance;
      s += std::max(voxel_m_, distance) * per_metre;
    } else {
      if (outside < 0) return false;  // from behind
      depth = outside + (s - outside) * outside_distance / (outside_distance - distance);
      return onto_surface(cursor, origin, ray, depth, sample);
    }
  }
  return false;
}

// The depths between which each tile of the image shows blocks of the model.
std::vector<ModelVolume::Range> ModelVolume::ranges(const Camera& grid, const Isometry3d& frame_from_world, int tiles_x,
                                                    int tiles_y) const {
  std::vector<Range> tiles(static_cast<std::size_t>(tiles_x) * tiles_y);
  const float radius_m = kHalfDiagonal * block_m_;
  const Eigen::Matrix3f rotation = frame_from_world.linear().cast<float>();
  const Vector3f translation = frame_from_world.translation().cast<float>();
  for (const Cell& cell : cells_) {
    const Vector3f centre = rotation * ((cell.cast<float>() + Vector3f::Constant(0.5f)) * block_m_) + translation;
    if (centre.z() < radius_m + kNearest_m) continue;
    // Without distortion, which moves nothing inside the image by more than a tile.
    const auto u = static_cast<float>(grid.fx * centre.x() / centre.z() + grid.cx);
    const auto v = static_cast<float>(grid.fy * centre.y() / centre.z() + grid.cy);
    const float reach = radius_m / centre.z() * static_cast<float>(std::max(grid.fx, grid.fy)) + kTile;
    if (u + reach < 0 || v + reach < 0 || u - reach > static_cast<float>(grid.width) ||
        v - reach > static_cast<float>(grid.height))
      continue;
    const auto tile = [](float c, int count) { return std::clamp(static_cast<int>(c / kTile), 0, count - 1); };
    for (int y = tile(v - reach, tiles_y); y <= tile(v + reach, tiles_y); ++y)
      for (int x = tile(u - reach, tiles_x); x <= tile(u + reach, tiles_x); ++x) {
        Range& range = tiles[static_cast<std::size_t>(y) * tiles_x + x];
        range.near = std::min(range.near, centre.z() - radius_m);
        range.far = std::max(range.far, centre.z() + radius_m);
      }
  }
  return tiles;
}

DepthMap ModelVolume::ray_cast(const Camera& grid, const cv::Mat& rays, const Isometry3d& world_from_frame) const {
  DepthMap map;
  map.camera = grid;
  const auto count = static_cast<std::size_t>(grid.width) * grid.height;
  map.points.assign(count, Vector3f::Zero());
  map.normals.assign(count, Vector3f::Zero());
  map.sigma_m.assign(count, 0);
  const int tiles_x = grid.width / kTile + 1, tiles_y = grid.height / kTile + 1;
  const auto tiles = ranges(grid, world_from_frame.inverse(), tiles_x, tiles_y);
  const Eigen::Matrix3f rotation = world_from_frame.linear().cast<float>();
  const Vector3f origin = world_from_frame.translation().cast<float>();
  tbb::parallel_for(0, grid.height, [&](int y) {
    for (int x = 0; x < grid.width; ++x) {
      const Range& range = tiles[static_cast<std::size_t>(y / kTile) * tiles_x + x / kTile];
      const cv::Vec2d& at = rays.at<cv::Vec2d>(y, x);
      const Vector3f ray(static_cast<float>(at[0]), static_cast<float>(at[1]), 1);
      float depth = 0;
      Sample sample;
      if (!hit(origin, rotation * ray, range, depth, sample)) continue;
      const Vector3f normal = rotation.transpose() * sample.gradient.normalized();
      const std::size_t k = static_cast<std::size_t>(y) * grid.width + x;
      map.points[k] = depth * ray;
      if (-normal.dot(ray) < kLeastCosine * ray.norm()) continue;
      map.normals[k] = normal;
      map.sigma_m[k] = std::max(kLeastSigma_m, 1e-3f / std::sqrt(sample.weight));  // weights are per square millimetre
    }
  });
  map.valid = static_cast<int>(std::count_if(map.sigma_m.begin(), map.sigma_m.end(), [](float s) { return s > 0; }));
  return map;
}

}  // namespace dressform
