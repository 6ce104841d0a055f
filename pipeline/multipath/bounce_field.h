#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// A depth image in small squares of pixels. Arrays hold columns * rows values, metres, sensor frame; z = 0: no surface.
struct SurfaceCells {
  int edge_px = 8, columns = 0, rows = 0;
  std::vector<float> x, y, z, normal_x, normal_y, normal_z;  // normals: unit, towards the sensor
  std::vector<float> solid_angle;                            // of what was seen in the cell
  std::vector<float> ir_counts;                              // mean amplitude; empty without an infrared picture
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

// By how much depth comes out too large in every cell, metres along the optical axis, when every cell lights every
// other with its albedo: one bounce between matt surfaces, without a look at what stands between; decoded as the
// Kinect v2's driver does. Fuchs, ICPR 2010; Jimenez et al., Image and Vision Computing 2014.
std::vector<float> bounce_errors_m(const SurfaceCells& cells, const std::vector<float>& albedo);

// The image less factor x error, interpolated between cells of one surface.
cv::Mat subtract_errors(const cv::Mat& depth_mm, const SurfaceCells& cells, const std::vector<float>& errors_m,
                        double factor);

}  // namespace dressform
