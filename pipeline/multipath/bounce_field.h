#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// A depth image in small squares of pixels. Arrays hold columns * rows values, metres, sensor frame; z = 0: no surface.
struct SurfaceCells {
  int edge_px = 8, columns = 0, rows = 0;
  std::vector<float> x, y, z, normal_x, normal_y, normal_z;  // normals: unit, towards the sensor
  std::vector<float> solid_angle;                            // of what was seen in the cell
  std::vector<float> ir_counts;                              // mean amplitude; empty without an infrared image
  int count() const { return columns * rows; }
};

// What the images of one sensor share.
struct DepthOptics {
  SensorCalibration calibration;
  cv::Mat rays;  // normalized_grid of the IR camera
  explicit DepthOptics(const SensorCalibration& sensor) : calibration(sensor), rays(normalized_grid(sensor.ir)) {}
};

// `ir` may be empty. A cell is a plane fitted to the pixels near its median depth; normals are then averaged over
// neighbouring cells of the same surface, since noise must not make a flat wall light itself.
SurfaceCells surface_cells(const cv::Mat& depth_mm, const cv::Mat& ir, const DepthOptics& optics);

// Albedo in the infrared, 0 to 1, from the amplitude that came back; 0 where there is no surface.
std::vector<float> albedo_of(const SurfaceCells& cells, double signal_counts);

// Light that came by a detour, in every cell: sums of phasors, relative to the cell's own direct path, for a surface
// that would send all of it back.
struct BouncedLight {
  static constexpr int terms = 6;  // cosine and sine at 80, 16 and 120 MHz
  int count = 0;
  std::vector<float> sums;  // terms x count
  const float* term(int t) const { return &sums[static_cast<std::size_t>(t) * count]; }
};

// Every cell lights every other with its albedo: one bounce between matt surfaces, without a look at what stands
// between. Fuchs, ICPR 2010; Jimenez et al., Image and Vision Computing 2014.
BouncedLight bounced_light(const SurfaceCells& cells, const std::vector<float>& albedo);

constexpr double kLeastLitCosine = 0.1;  // below, direct light is too weak to divide by

// What the emitter sends straight to a surface and the lens takes from it, in the units of BouncedLight: at a place
// (metres, sensor frame) whose normal is `cosine` off the way to the emitter. The cosine counts as kLeastLitCosine at
// least.
double direct_light(double x, double y, double z, double cosine);
double lit_cosine(double x, double y, double z, const Eigen::Vector3d& normal);
// Amplitude, in the units of BouncedLight, of an infrared value of 1 count on a white surface.
double light_per_count(double x, double y, double z, double signal_counts);

// By how much depth comes out too large, metres along the optical axis, where `direct` and the bounced phasors arrive;
// decoded as the Kinect v2's driver does.
double bounce_error_m(double direct, const float (&bounced)[BouncedLight::terms], double stretch);
// The same in every cell.
std::vector<float> bounce_errors_m(const SurfaceCells& cells, const BouncedLight& light);

}  // namespace dressform
