#include "pipeline/fuse/block_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dressform {
namespace {

constexpr int kKeyBits = 21, kKeyOffset = 1 << 20;
constexpr int kTile = 8;
constexpr std::size_t kLeastFrames = 3;  // that saw something in a block
constexpr float kLargestStep_m = 0.03f;  // between the four pixels of one surface, to read depth between them
constexpr float kInFront_m = 0.1f;       // what is nearer to the sensor than this it does not see
constexpr float kHalfDiagonal = 0.87f;   // of a cube, in edges: sqrt(3) / 2, rounded up
constexpr float kWithinBand = 0.95f;     // of the truncation: values at the band's end are no distances
constexpr float kLeastGradient = 0.2f;   // of a voxel's edge, from neighbour to neighbour: else there is no direction

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

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

// What the volume needs to know of a frame, laid out for the inner loop.
struct FrameView {
  cv::Mat depth_m;
  int shrink = 1, width = 0, height = 0;  // of the grid below
  std::vector<float> along;   // minus normal times ray (of unit z): from a step in depth to one off the plane
  std::vector<float> weight;  // of an observation; 0: none
  int tiles_x = 0, tiles_y = 0;
  std::vector<float> farthest;  // depth in every tile of kTile x kTile grid pixels; 0: none
  Eigen::Matrix3f rotation;     // sensor from model
  Vector3f translation;
};

FrameView frame_view(const cv::Mat& depth_m, const DepthMap& map, const Camera& camera,
                     const Isometry3d& frame_from_model, double min_cosine) {
  FrameView view;
  view.depth_m = depth_m;
  view.width = map.camera.width;
  view.height = map.camera.height;
  view.shrink = camera.width / view.width;
  view.along.assign(map.points.size(), 0);
  view.weight.assign(map.points.size(), 0);
  view.tiles_x = view.width / kTile + 1;
  view.tiles_y = view.height / kTile + 1;
  view.farthest.assign(static_cast<std::size_t>(view.tiles_x) * view.tiles_y, 0);
  view.rotation = frame_from_model.linear().cast<float>();
  view.translation = frame_from_model.translation().cast<float>();
  for (int k = 0; k < static_cast<int>(map.points.size()); ++k) {
    if (!map.has_normal(k)) continue;
    const Vector3f ray = map.points[k] / map.points[k].z();
    const float along = -map.normals[k].dot(ray), cosine = along / ray.norm(), sigma_mm = 1e3f * map.sigma_m[k];
    if (cosine < min_cosine) continue;
    view.along[k] = along;
    view.weight[k] = cosine * cosine / (sigma_mm * sigma_mm);
    float& tile = view.farthest[(k / view.width / kTile) * view.tiles_x + (k % view.width) / kTile];
    tile = std::max(tile, map.points[k].z());
  }
  return view;
}

// Whether a ball may hold anything that the frame saw, or that lies in front of it.
bool may_see(const FrameView& view, const Projector& projector, const Camera& camera, const Vector3f& centre,
             float radius_m) {
  if (centre.z() < radius_m + kInFront_m) return false;
  Vector2f pixel;
  if (!projector(centre, pixel)) return false;
  const float reach = (radius_m / centre.z() * static_cast<float>(camera.fx) + 2) / view.shrink;
  const float u = pixel.x() / view.shrink, v = pixel.y() / view.shrink;
  const auto tile = [](float c, int count) {
    return std::clamp(static_cast<int>(std::floor(c)) / kTile, 0, count - 1);
  };
  for (int y = tile(v - reach, view.tiles_y); y <= tile(v + reach, view.tiles_y); ++y)
    for (int x = tile(u - reach, view.tiles_x); x <= tile(u + reach, view.tiles_x); ++x)
      if (view.farthest[static_cast<std::size_t>(y) * view.tiles_x + x] > centre.z() - radius_m) return true;
  return false;
}

// One frame into one block. Rows of voxels are projected at both ends and filled in between: over a block the
// projection is straight to a few hundredths of a pixel.
template <class Block>
void integrate(const FrameView& view, const Projector& projector, const Camera& camera, const Vector3f& origin,
               const VolumeOptions& options, Block& block) {
  constexpr int kEdge = BlockVolume::kEdge;
  const auto voxel_m = static_cast<float>(options.voxel_m), truncation_m = static_cast<float>(options.truncation_m);
  const Vector3f middle = origin + Vector3f::Constant(0.5f * (kEdge - 1) * voxel_m);
  if (!may_see(view, projector, camera, view.rotation * middle + view.translation, kHalfDiagonal * kEdge * voxel_m))
    return;
  const Vector3f first = view.rotation * origin + view.translation, step = view.rotation.col(0) * voxel_m;
  const float per_pixel = 1.0f / view.shrink;
  for (int z = 0, k = 0; z < kEdge; ++z)
    for (int y = 0; y < kEdge; ++y, k += kEdge) {
      const Vector3f row = first + (y * view.rotation.col(1) + z * view.rotation.col(2)) * voxel_m;
      Vector2f begin, end;
      if (!projector(row, begin) || !projector(row + (kEdge - 1) * step, end)) continue;
      const Vector2f pixel_step = (end - begin) / (kEdge - 1);
      for (int x = 0; x < kEdge; ++x) {
        const Vector2f pixel = begin + x * pixel_step;
        const int u = std::min(view.width - 1, static_cast<int>((pixel.x() + 0.5f) * per_pixel));
        const int v = std::min(view.height - 1, static_cast<int>((pixel.y() + 0.5f) * per_pixel));
        const int index = v * view.width + u;
        const float weight = view.weight[index];
        if (weight == 0) continue;
        const float depth = depth_at(view.depth_m, pixel, kLargestStep_m);
        if (depth == 0) continue;
        const float off = (depth - (row.z() + x * step.z())) * view.along[index];
        if (off < -truncation_m) continue;
        const float sum = block.weight[k + x] + weight;
        block.distance[k + x] += (std::min(off, truncation_m) - block.distance[k + x]) * (weight / sum);
        block.weight[k + x] = sum;
        ++block.observations[k + x];
      }
    }
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
  std::vector<FrameView> views(frames.count());
  tbb::parallel_for(0, frames.count(), [&](int i) {
    if (used[i] && frames.usable[i])
      views[i] =
          frame_view(frames.depth_m[i], frames.maps[i], camera, model_from_frame[i].inverse(), options.min_cosine);
  });
  const Projector projector(camera);
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
    const Vector3f origin = (block_of(keys_[b]) * kEdge).cast<float>() * static_cast<float>(options_.voxel_m);
    Block& block = blocks_[b];
    std::fill(std::begin(block.distance), std::end(block.distance), 0.0f);
    std::fill(std::begin(block.weight), std::end(block.weight), 0.0f);
    std::fill(std::begin(block.observations), std::end(block.observations), std::uint16_t{0});
    for (const FrameView& view : views)
      if (!view.weight.empty()) integrate(view, projector, camera, origin, options_, block);
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
  std::vector<std::uint64_t> all;
  for (const auto& keys : found) all.insert(all.end(), keys.begin(), keys.end());
  std::sort(all.begin(), all.end());
  for (std::size_t k = 0; k + kLeastFrames <= all.size(); ++k)  // what only a few frames claim is noise
    if (all[k] == all[k + kLeastFrames - 1] && (keys_.empty() || keys_.back() != all[k])) keys_.push_back(all[k]);
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
  return result.norm() > kLeastGradient * static_cast<float>(options_.voxel_m);
}

void BlockVolume::block_points(std::size_t b, int least_observations, PointCloud& cloud) const {
  const Cell origin = block_of(keys_[b]) * kEdge;
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
