#include "pipeline/fuse/frame_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

namespace dressform {
namespace {

constexpr int kEdge = VoxelBlock::kEdge;
constexpr int kTile = 8;                 // grid pixels
constexpr float kLargestStep_m = 0.03f;  // between the four pixels of one surface, to read depth between them
constexpr float kInFront_m = 0.1f;       // what is nearer to the sensor than this it does not see
constexpr float kHalfDiagonal = 0.87f;   // of a cube, in edges: sqrt(3) / 2, rounded up

using cv::v_float32x4;
using cv::v_int32x4;

v_float32x4 all(float value) { return cv::v_setall_f32(value); }

// Four places in an image between four pixels each: the index of the upper left one, and the way on to the others.
struct Between {
  v_int32x4 upper_left;
  v_float32x4 right, down;  // 0 to 1 inside the image
};

// Whole pixels, not beyond the last one. Pixels are never below -0.5, so that conversion to int rounds as std::floor
// and std::lround would, clamped at 0; without SSE 4.1 those are calls into libm, in the stage's innermost loop.
v_float32x4 whole(const v_float32x4& pixel, int last) {
  return cv::v_cvt_f32(cv::v_trunc(cv::v_min(pixel, all(static_cast<float>(last)))));
}

// Index of a pixel in an image of less than 2^24 numbers: exact in single precision, where SSE 2 multiplies.
v_int32x4 index_of(const v_float32x4& x, const v_float32x4& y, std::size_t stride) {
  return cv::v_trunc(y * all(static_cast<float>(stride)) + x);
}

Between between_pixels(const v_float32x4& u, const v_float32x4& v, const cv::Mat& image) {
  const v_float32x4 x = whole(u, image.cols - 2), y = whole(v, image.rows - 2);
  return {index_of(x, y, image.step1()), u - x, v - y};
}

// Depth between the four pixels where they hold one surface, else the nearest pixel's.
v_float32x4 depth_at(const cv::Mat& depth_m, const Between& at) {
  const v_float32x4 zero = cv::v_setzero_f32(), half = all(0.5f), one = all(1);
  v_float32x4 top, top_next, bottom, bottom_next;
  cv::v_lut_deinterleave(depth_m.ptr<float>(0), at.upper_left, top, top_next);
  cv::v_lut_deinterleave(depth_m.ptr<float>(1), at.upper_left, bottom, bottom_next);
  const v_float32x4 low = cv::v_min(cv::v_min(top, top_next), cv::v_min(bottom, bottom_next));
  const v_float32x4 high = cv::v_max(cv::v_max(top, top_next), cv::v_max(bottom, bottom_next));
  const v_float32x4 &a = at.right, &b = at.down;
  const v_float32x4 inside = (a >= zero) & (a < one) & (b >= zero) & (b < one);
  const v_float32x4 one_surface = inside & (low > zero) & (high - low < all(kLargestStep_m));
  const v_float32x4 bilinear =
      (top * (one - a) + top_next * a) * (one - b) + (bottom * (one - a) + bottom_next * a) * b;
  const v_float32x4 nearest =
      cv::v_select(b >= half, cv::v_select(a >= half, bottom_next, bottom), cv::v_select(a >= half, top_next, top));
  return cv::v_select(one_surface, bilinear, nearest);
}

// Four neighbouring voxels of a row: where the frame sees them, and how deep they lie.
struct Voxels {
  v_float32x4 u, v, z;
};

void observations_at(const FrameView& view, const Voxels& voxels, v_float32x4& along, v_float32x4& weight) {
  const v_float32x4 per_pixel = all(1.0f / static_cast<float>(view.shrink)), half = all(0.5f);
  const v_float32x4 x = whole((voxels.u + half) * per_pixel, view.width - 1);
  const v_float32x4 y = whole((voxels.v + half) * per_pixel, view.height - 1);
  const v_int32x4 index = index_of(x, y, static_cast<std::size_t>(view.width)) << 1;  // in floats
  cv::v_lut_deinterleave(&view.observations[0].along, index, along, weight);
}

// The running average of four voxels. No branches: what does not count is selected away.
void integrate_voxels(const FrameView& view, const Voxels& voxels, float truncation_m, float* distance, float* weight,
                      std::uint16_t* observations) {
  const v_float32x4 zero = cv::v_setzero_f32(), truncation = all(truncation_m);
  v_float32x4 along, added;
  observations_at(view, voxels, along, added);
  const v_float32x4 seen = added != zero;
  if (cv::v_signmask(seen) == 0) return;
  const v_float32x4 depth = depth_at(view.depth_m, between_pixels(voxels.u, voxels.v, view.depth_m));
  const v_float32x4 off = (depth - voxels.z) * along;
  const v_float32x4 counted = seen & (depth != zero) & (off >= zero - truncation);
  const int lanes = cv::v_signmask(counted);
  if (lanes == 0) return;
  const v_float32x4 before = cv::v_load(distance), weight_before = cv::v_load(weight), sum = weight_before + added;
  const v_float32x4 part = added / cv::v_select(counted, sum, all(1));
  const v_float32x4 average = before + (cv::v_min(off, truncation) - before) * part;
  cv::v_store(distance, cv::v_select(counted, average, before));
  cv::v_store(weight, cv::v_select(counted, sum, weight_before));
  for (int k = 0; k < 4; ++k) observations[k] = static_cast<std::uint16_t>(observations[k] + ((lanes >> k) & 1));
}

}  // namespace

FrameView frame_view(const cv::Mat& depth_m, const DepthMap& map, const Camera& camera,
                     const Isometry3d& frame_from_volume, double min_cosine) {
  FrameView view;
  view.depth_m = depth_m;
  view.width = map.camera.width;
  view.height = map.camera.height;
  view.shrink = camera.width / view.width;
  view.observations.resize(map.points.size());
  view.tiles_x = view.width / kTile + 1;
  view.tiles_y = view.height / kTile + 1;
  view.farthest.assign(static_cast<std::size_t>(view.tiles_x) * view.tiles_y, 0);
  view.rotation = frame_from_volume.linear().cast<float>();
  view.translation = frame_from_volume.translation().cast<float>();
  for (int k = 0; k < static_cast<int>(map.points.size()); ++k) {
    if (!map.has_normal(k)) continue;
    const Vector3f ray = map.points[k] / map.points[k].z();
    const float along = -map.normals[k].dot(ray), cosine = along / ray.norm(), sigma_mm = 1e3f * map.sigma_m[k];
    if (cosine < min_cosine) continue;
    view.observations[k] = {along, cosine * cosine / (sigma_mm * sigma_mm)};
    float& tile = view.farthest[(k / view.width / kTile) * view.tiles_x + (k % view.width) / kTile];
    tile = std::max(tile, map.points[k].z());
  }
  return view;
}

bool may_see(const FrameView& view, const Projector& projector, const Camera& camera, const Vector3f& origin,
             float voxel_m) {
  const Vector3f middle = origin + Vector3f::Constant(0.5f * (kEdge - 1) * voxel_m);
  const Vector3f centre = view.rotation * middle + view.translation;
  const float radius_m = kHalfDiagonal * kEdge * voxel_m;
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

void integrate(const FrameView& view, const Projector& projector, const Vector3f& origin, const VolumeOptions& options,
               VoxelBlock& block) {
  const auto voxel_m = static_cast<float>(options.voxel_m), truncation_m = static_cast<float>(options.truncation_m);
  const Vector3f first = view.rotation * origin + view.translation, step = view.rotation.col(0) * voxel_m;
  const v_float32x4 four(0, 1, 2, 3);
  for (int z = 0, k = 0; z < kEdge; ++z)
    for (int y = 0; y < kEdge; ++y, k += kEdge) {
      const Vector3f row = first + (y * view.rotation.col(1) + z * view.rotation.col(2)) * voxel_m;
      Vector2f begin, end;
      if (!projector(row, begin) || !projector(row + (kEdge - 1) * step, end)) continue;
      const Vector2f pixel_step = (end - begin) / (kEdge - 1);
      for (int x = 0; x < kEdge; x += 4) {
        const v_float32x4 at = all(static_cast<float>(x)) + four;
        const Voxels voxels{all(begin.x()) + at * all(pixel_step.x()), all(begin.y()) + at * all(pixel_step.y()),
                            all(row.z()) + at * all(step.z())};
        integrate_voxels(view, voxels, truncation_m, block.distance + k + x, block.weight + k + x,
                         block.observations + k + x);
      }
    }
}

}  // namespace dressform
