#include "synthetic/sensors/known_scenes.h"

#include <cmath>
#include <utility>
#include <vector>

#include "synthetic/capture/shapes.h"

namespace dressform {

RaySurface known_surface(Mesh mesh, float nir_albedo, bool smooth) {
  RaySurface result;
  result.name = "known";
  result.mesh = std::move(mesh);
  result.smooth = smooth;
  result.material.nir_albedo = nir_albedo;
  return result;
}

RaySurface known_plane(double distance_m, double tilt_deg, float nir_albedo) {
  const double tilt = tilt_deg * M_PI / 180;
  const Vector3d u(std::cos(tilt), 0, std::sin(tilt)), v(0, 1, 0);
  return known_surface(grid_mesh(Vector3d(0, 0, distance_m) - 20 * u - 20 * v, 40 * u, 40 * v, 1), nir_albedo);
}

RayScene scene_of(RaySurface only) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(std::move(only));
  return RayScene(std::move(surfaces));
}

RayScene plate_before_wall(double gap_m) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(known_plane(2 + gap_m, 0));
  surfaces.push_back(known_surface(grid_mesh({-0.4, -0.6, 2}, {1, 0.2, 0}, {-0.2, 1, 0}, 1), 0.6f));
  return RayScene(std::move(surfaces));
}

RayScene receding_floor() {
  return scene_of(known_surface(grid_mesh({-0.5, 0.3, 0.5}, {1, 0, 0}, {0, -0.7, 4.5}, 0.1), 1.0f));
}

double true_plane_depth(const Camera& camera, int x, int y, double distance_m, double tilt_deg) {
  const double slope = std::tan(tilt_deg * M_PI / 180);
  return distance_m / (1 - slope * camera.normalized({static_cast<double>(x), static_cast<double>(y)}).x());
}

SensorFrame measure_scene(const RayScene& scene, const std::string& model, const FieldValues& values, Seed seed,
                          double depth_offset_m, const Camera& camera) {
  const RayTable rays(camera);
  const IrView view(scene, rays, camera, Isometry3d::Identity(), depth_offset_m);
  return SensorModel::at(model).run(view, values, seed);
}

}  // namespace dressform
