#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/registry.h"
#include "synthetic/capture/indirect_light.h"
#include "synthetic/capture/ray_table.h"

namespace dressform {

// How a colour camera turns light into numbers.
struct FilmSpec {
  float gain = 1;                             // linear; nominal exposure times the sensor's own
  Vector3f white_balance = Vector3f::Ones();  // linear, RGB
  float electrons_full_scale = 2500;          // shot noise: about 10 electrons for one 8-bit step
  float read_noise_electrons = 3;
  float vignetting = 0.3f;  // part of the cos^4 law that the lens leaves uncorrected
};

// 8-bit BGR, sRGB, as the raw (distorted) camera sees the scene: four samples a pixel, soft shadows, one bounce,
// Poisson and read noise. Bytes depend on (scene, camera, seed) only.
cv::Mat render_color(const RayScene& scene, const Lighting& lighting, const IndirectLight& indirect,
                     const RayTable& rays, const Isometry3d& world_from_camera, const FilmSpec& film, Seed seed);

// uint8, what each pixel's centre hits first (`Label`).
cv::Mat render_labels(const RayScene& scene, const RayTable& rays, const Isometry3d& world_from_camera);

// Cameras ignore what is nearer than this: their own housing.
constexpr float camera_near_m = 0.2f;
constexpr float camera_far_m = 30.0f;

}  // namespace dressform
