#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/registry.h"
#include "synthetic/capture/film.h"
#include "synthetic/capture/indirect_light.h"
#include "synthetic/capture/ray_table.h"

namespace dressform {

// 8-bit BGR, sRGB, as the raw (distorted) camera sees the scene: four samples a pixel, soft shadows, one bounce,
// developed as the film says. Bytes depend on (scene, camera, seed) only.
cv::Mat render_color(const RayScene& scene, const Lighting& lighting, const IndirectLight& indirect,
                     const RayTable& rays, const Isometry3d& world_from_camera, const FilmSpec& film, Seed seed);

// uint8, what each pixel's centre hits first (`Label`).
cv::Mat render_labels(const RayScene& scene, const RayTable& rays, const Isometry3d& world_from_camera);

// Cameras ignore what is nearer than this: their own housing.
constexpr float camera_near_m = 0.2f;
constexpr float camera_far_m = 30.0f;

}  // namespace dressform
