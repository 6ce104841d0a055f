#include "synthetic/capture/color_camera.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "synthetic/capture/shading.h"

namespace dressform {
namespace {

constexpr int block = 4;  // one packet is a 4 x 4 block of pixels
constexpr int pixel_samples = 4;
constexpr int penumbra_samples = 12;
// A rotated grid: four samples that share no row and no column.
constexpr float sample_offset[pixel_samples][2] = {
    {-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}};

struct Eye {
  const RayTable& rays;
  Eigen::Matrix3f rotation;
  Vector3f position;

  Eye(const RayTable& table, const Isometry3d& world_from_camera)
      : rays(table),
        rotation(world_from_camera.linear().cast<float>()),
        position(world_from_camera.translation().cast<float>()) {}

  // Direction with unit z in the camera frame, so that t is the depth along the axis.
  Vector3f direction(const Vector2f& ideal) const { return rotation * Vector3f(ideal.x(), ideal.y(), 1.0f); }
};

// Rays of a block, through the pixels' centres moved by (dx, dy).
RayPacket block_rays(const Eye& eye, int left, int top, float dx, float dy) {
  RayPacket rays;
  for (int lane = 0; lane < packet_size; ++lane) {
    const int x = left + lane % block, y = top + lane / block;
    if (x >= eye.rays.width() || y >= eye.rays.height()) continue;
    const Vector2f ideal = dx == 0 && dy == 0 ? eye.rays.at(x, y) : eye.rays.at(x + dx, y + dy);
    rays.set(lane, eye.position, eye.direction(ideal), camera_near_m, camera_far_m);
  }
  return rays;
}

template <class Body>
void for_each_block(int width, int height, const Body& body) {
  const int columns = (width + block - 1) / block, rows = (height + block - 1) / block;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 4, 0, columns, 8), [&](const tbb::blocked_range2d<int>& range) {
    for (int row = range.rows().begin(); row < range.rows().end(); ++row)
      for (int column = range.cols().begin(); column < range.cols().end(); ++column) body(column * block, row * block);
  });
}

struct BlockSums {
  Vector3f albedo[packet_size], irradiance[packet_size], direct[packet_size], other[packet_size];
  int seen_by_all[packet_size], seen_by_any[packet_size], hits[packet_size];
  BlockSums() {
    for (int lane = 0; lane < packet_size; ++lane) {
      albedo[lane].setZero(), irradiance[lane].setZero(), direct[lane].setZero(), other[lane].setZero();
      seen_by_all[lane] = ~0, seen_by_any[lane] = 0, hits[lane] = 0;
    }
  }
  void add(const ShadedPacket& shaded) {
    for (int lane = 0; lane < packet_size; ++lane) {
      albedo[lane] += shaded.albedo[lane];
      irradiance[lane] += shaded.direct[lane];
      direct[lane] += shaded.albedo[lane].cwiseProduct(shaded.direct[lane]);
      other[lane] += shaded.other[lane];
      seen_by_all[lane] &= shaded.seen[lane];
      seen_by_any[lane] |= shaded.seen[lane];
      hits[lane] += shaded.points.valid[lane];
    }
  }
  // All samples lie on cloth, skin or wall, and they disagree about a bulb.
  bool penumbra(int lane) const { return hits[lane] == pixel_samples && seen_by_all[lane] != seen_by_any[lane]; }
};

// Mean irradiance from many more shadow rays where the four samples disagree: penumbras stay free of grain.
void refine_penumbra(const LitScene& world, PointPacket points, BlockSums& sums) {
  bool any = false;
  for (int lane = 0; lane < packet_size; ++lane) any |= points.valid[lane] &= sums.penumbra(lane);
  if (!any) return;
  const float no_gloss[packet_size] = {};
  Vector3f extra[packet_size];
  for (auto& each : extra) each.setZero();
  for (int i = 0; i < penumbra_samples; ++i) {
    int sample[packet_size];
    std::fill(sample, sample + packet_size, 4 * (i / 3) + 1 + i % 3);  // those that the first four samples left out
    const DirectLight more =
        direct_light(world.scene, world.lighting, points, points.position, no_gloss, sample, Coherence::coherent);
    for (int lane = 0; lane < packet_size; ++lane) extra[lane] += more.irradiance[lane];
  }
  for (int lane = 0; lane < packet_size; ++lane)
    if (points.valid[lane])
      sums.direct[lane] =
          sums.albedo[lane].cwiseProduct(sums.irradiance[lane] + extra[lane]) / (pixel_samples + penumbra_samples);
}

BlockSums render_block(const LitScene& world, const Eye& eye, int left, int top, float footprint_per_m) {
  BlockSums sums;
  ShadedPacket shaded;
  for (int s = 0; s < pixel_samples; ++s) {
    const RayPacket rays = block_rays(eye, left, top, sample_offset[s][0], sample_offset[s][1]);
    HitPacket hits;
    world.scene.intersect(rays, hits, Coherence::coherent);
    int bulb_sample[packet_size];
    std::fill(bulb_sample, bulb_sample + packet_size, 4 * s);
    shaded = shade(world, rays, hits, footprint_per_m, bulb_sample);
    sums.add(shaded);
  }
  refine_penumbra(world, shaded.points, sums);
  return sums;
}

// What the lens lets through away from its axis.
float lens_factor(const Vector2f& ideal, float vignetting) {
  const float cosine2 = 1.0f / (1.0f + ideal.squaredNorm());
  return 1.0f - vignetting * (1.0f - cosine2 * cosine2);
}

}  // namespace

cv::Mat render_color(const RayScene& scene, const Lighting& lighting, const IndirectLight& indirect,
                     const RayTable& rays, const Isometry3d& world_from_camera, const FilmSpec& film, Seed seed) {
  const LitScene world{scene, lighting, indirect};
  const Eye eye(rays, world_from_camera);
  const int width = rays.width(), height = rays.height();
  // Four samples share a pixel: each stands for half its width.
  const float footprint_per_m = 0.5f * (rays.at(width / 2 + 1, height / 2) - rays.at(width / 2, height / 2)).norm();
  cv::Mat light(height, width, CV_32FC3);
  for_each_block(width, height, [&](int left, int top) {
    const BlockSums sums = render_block(world, eye, left, top, footprint_per_m);
    for (int lane = 0; lane < packet_size; ++lane) {
      const int x = left + lane % block, y = top + lane / block;
      if (x >= width || y >= height) continue;
      const Vector3f rgb =
          (sums.direct[lane] + sums.other[lane]) * (lens_factor(rays.at(x, y), film.vignetting) / pixel_samples);
      light.at<cv::Vec3f>(y, x) = {rgb[0], rgb[1], rgb[2]};
    }
  });
  return developed(light, film, seed);
}

cv::Mat render_labels(const RayScene& scene, const RayTable& rays, const Isometry3d& world_from_camera) {
  const Eye eye(rays, world_from_camera);
  cv::Mat labels(rays.height(), rays.width(), CV_8UC1, cv::Scalar(0));
  for_each_block(rays.width(), rays.height(), [&](int left, int top) {
    const RayPacket packet = block_rays(eye, left, top, 0, 0);
    HitPacket hits;
    scene.intersect(packet, hits, Coherence::coherent);
    for (int lane = 0; lane < packet_size; ++lane)
      if (hits.surface[lane] >= 0)
        labels.at<std::uint8_t>(top + lane / block, left + lane % block) =
            static_cast<std::uint8_t>(scene.surfaces()[hits.surface[lane]].label);
  });
  return labels;
}

}  // namespace dressform
