#pragma once
#include <set>
#include <string>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// A published curve of noise along the optical axis. Parts are of its value: how far a simulation of the device may be
// off; 0: drawn, but nobody is judged by it.
struct PublishedNoise {
  std::string name;                                  // "Fankhauser 2015"
  double (*sigma_mm)(double z_m, double theta_rad);  // see scenes/devices/noise.h
  double part_by_distance = 0, part_by_angle = 0;
  bool knows_angle = true;
};

// A figure measured at `at`, and what it has to lie between. `value`: NaN where only the range is known.
struct ExpectedFigure {
  double at = 0, value = 0, low = 0, high = 0;
};

// What is known of a real depth sensor, by the name that calibrations give as its `model`. One file each:
// scenes/devices/<name>.cpp, or beside the sensor model that simulates it. Nobody else asks for names.
struct SensorDevice {
  std::string name;
  bool time_of_flight = false;  // light that arrives by a detour makes depth too long
  Camera ir_camera;             // of a usual unit at full size
  // Figures that a simulation is held to; empty where none were published.
  std::vector<PublishedNoise> noise;      // the first one by distance, the first one that knows angles by incidence
  std::vector<double> noise_distances_m;  // at which it is judged, of a white surface that faces the sensor
  std::vector<int> noise_angles_deg;      // the same at 2 m
  std::vector<ExpectedFigure> noise_by_albedo_mm;  // facing, at 2.1 m
  struct Holes {
    double albedo = 0;
    std::vector<ExpectedFigure> percent_by_angle_deg;
  };
  std::vector<Holes> holes;  // of pixels on a plane at 2.1 m
  struct FlyingPixels {
    double from_gap_m = 0, to_gap_m = 0, low = 0, high = 0;  // per pixel of contour
  };
  std::vector<FlyingPixels> flying_pixels;  // of a plate at 2 m, by the gap behind it
  std::vector<ExpectedFigure> correlation;  // of the noise of pixels in one row, by their distance in pixels
  double decoding_error_mm = 0;             // the largest without noise; 0: not known
  // Where only some depths can be measured: the step from one to the next, and all of them in a range. Else null.
  double (*step_mm)(double z_m) = nullptr;
  std::set<int> (*levels_mm)(int from_mm, int to_mm) = nullptr;

  const PublishedNoise* noise_by_angle() const;  // null: none was published
};

// Null where no such device is declared.
const SensorDevice* find_device(const std::string& name);

// The device whose usual camera has this image size: the first by name; null: none has.
const SensorDevice* find_device(int width, int height);

// `const DeviceDeclaration name_device{device};` makes a device known. Throws std::logic_error for a name that is
// taken.
struct DeviceDeclaration {
  explicit DeviceDeclaration(SensorDevice device);
};

}  // namespace dressform
