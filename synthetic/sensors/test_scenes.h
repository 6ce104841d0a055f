#pragma once
#include "synthetic/capture/shapes.h"
#include "synthetic/sensors/known_scenes.h"

// Known scenes under the short names of the sensors' tests.
namespace dressform::test_scenes {

inline Camera kinect() { return Camera{256, 212, 183, 183, 127.5, 105.5, {0.09, -0.27, 0, 0, 0.1}}; }

inline RaySurface surface(Mesh mesh, float nir_albedo, bool smooth = false) {
  return known_surface(std::move(mesh), nir_albedo, smooth);
}
inline RaySurface plane(double distance_m, double tilt_deg, float nir_albedo = 0.6f) {
  return known_plane(distance_m, tilt_deg, nir_albedo);
}
inline SensorFrame measure(const RayScene& scene, const std::string& model, const FieldValues& values = {},
                           Seed seed = 1, double offset_m = 0, const Camera& camera = kinect()) {
  return measure_scene(scene, model, values, seed, offset_m, camera);
}
inline double true_depth(const Camera& camera, int x, int y, double distance_m, double tilt_deg) {
  return true_plane_depth(camera, x, y, distance_m, tilt_deg);
}

}  // namespace dressform::test_scenes
