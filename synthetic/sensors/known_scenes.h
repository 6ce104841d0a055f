#pragma once
#include <string>

#include "synthetic/sensors/sensor_model.h"

namespace dressform {

// Scenes whose depth is known, before a sensor at the origin. For measuring what a sensor model makes of them.

RaySurface known_surface(Mesh mesh, float nir_albedo, bool smooth = false);

// A wide plane through (0, 0, distance) turned about the vertical by `tilt_deg`.
RaySurface known_plane(double distance_m, double tilt_deg, float nir_albedo = 0.6f);

RayScene scene_of(RaySurface only);

// A plate of 1.2 m with slanted edges at 2 m, `gap_m` before a wall.
RayScene plate_before_wall(double gap_m);

// A floor that leads away from the sensor, from 0.5 to 5 m: shows every depth between.
RayScene receding_floor();

// Depth of the plane at a pixel, metres.
double true_plane_depth(const Camera& camera, int x, int y, double distance_m, double tilt_deg);

SensorFrame measure_scene(const RayScene& scene, const std::string& model, const FieldValues& values, Seed seed,
                          double depth_offset_m, const Camera& camera);

}  // namespace dressform
