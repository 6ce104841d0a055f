#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "synthetic/capture/shapes.h"
#include "synthetic/sensors/sensor_model.h"

// Scenes with known answers for the tests of sensor models.
namespace dressform::test_scenes {

inline Camera kinect() { return Camera{256, 212, 183, 183, 127.5, 105.5, {0.09, -0.27, 0, 0, 0.1}}; }

inline RaySurface surface(Mesh mesh, float nir_albedo, bool smooth = false) {
  RaySurface result;
  result.name = "test";
  result.mesh = std::move(mesh);
  result.smooth = smooth;
  result.material.nir_albedo = nir_albedo;
  return result;
}

// A wide plane through (0, 0, distance) turned about the vertical by `tilt_deg`, in the frame of a sensor at the
// origin.
inline RaySurface plane(double distance_m, double tilt_deg, float nir_albedo = 0.6f) {
  const double tilt = tilt_deg * M_PI / 180;
  const Vector3d u(std::cos(tilt), 0, std::sin(tilt)), v(0, 1, 0);
  return surface(grid_mesh(Vector3d(0, 0, distance_m) - 20 * u - 20 * v, 40 * u, 40 * v, 1), nir_albedo);
}

inline SensorFrame measure(const RayScene& scene, const std::string& model, const FieldValues& values = {},
                           Seed seed = 1, double offset_m = 0, const Camera& camera = kinect()) {
  const RayTable rays(camera);
  const IrView view(scene, rays, camera, Isometry3d::Identity(), offset_m);
  return SensorModel::at(model).run(view, values, seed);
}

inline RayScene scene_of(RaySurface only) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(std::move(only));
  return RayScene(std::move(surfaces));
}

inline double true_depth(const Camera& camera, int x, int y, double distance_m, double tilt_deg) {
  const double slope = std::tan(tilt_deg * M_PI / 180);
  return distance_m / (1 - slope * camera.normalized({static_cast<double>(x), static_cast<double>(y)}).x());
}

}  // namespace dressform::test_scenes
