#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scenes/devices/device.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {

// What a sensor model makes of known scenes, in figures: one place for its tests and for `dressform inspect`.

struct SensorSetup {
  std::string model;
  FieldValues values;
  Camera camera;
};

// The real device that a sensor model stands for: the one of its own name, else the default model's. What it is held
// to.
const SensorDevice& device_of(const std::string& model);
// Infrared camera of that device at full size.
Camera usual_camera(const std::string& model);

// Those of the values whose parameter the model has.
FieldValues those_it_has(const std::string& model, const FieldValues& values);

// Parameters of a model under which nothing but noise moves its depth; `without_noise` as well: what is left is the
// decoding. Parameters that the model does not have are left out.
FieldValues noise_only(const std::string& model);
FieldValues without_noise(const std::string& model);

// The white target of the published measurements.
constexpr float kWhiteAlbedo = 0.95f;

// Error of measured depth, millimetres, over the pixels that have one; `holes` is the part that have none.
struct DepthErrors {
  double mean_mm = 0, sigma_mm = 0, worst_mm = 0, holes = 0;
  long pixels = 0;
};

// Of a plane, over a window about the image centre in which the incidence stays near the tilt.
DepthErrors plane_errors(const cv::Mat& depth_mm, const Camera& camera, double distance_m, double tilt_deg,
                         int half_width, int half_height);
// Shoots the plane and takes the window that suits the tilt.
DepthErrors of_plane(const SensorSetup& setup, double distance_m, double tilt_deg, float nir_albedo, Seed seed = 1);
// Of a device that can measure some depths only: over nearly the whole image, at distances a quarter of a step apart so
// that the steps' own width counts as it does on average.
DepthErrors of_plane_between_steps(const SensorSetup& setup, double distance_m, int seeds);
// Over every third pixel of a facing plane.
DepthErrors decoding_errors(const SensorSetup& setup, double distance_m);

// Correlation of the noise with itself `lag` pixels to the right, lags 0 to `lags`, on a white plane at 3 m.
std::vector<double> noise_autocorrelation(const SensorSetup& setup, int lags);

// Depths that are neither the plate's nor the wall's, per pixel of contour of a plate at 2 m before a wall.
double flying_pixels(const SensorSetup& setup, double gap_m);

// Mean error by distance, on a plane without noise: 0.7 to 4.4 m.
std::map<double, double> wiggle_mm(const SensorSetup& setup);
double peak_to_peak(const std::map<double, double>& curve);

// All depths between `from_mm` and `to_mm` that come out before a receding floor.
std::set<int> depth_levels(const SensorSetup& setup, int from_mm, int to_mm);

}  // namespace dressform
