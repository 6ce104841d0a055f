#include "scenes/devices/device.h"
#include "scenes/devices/noise.h"

// Microsoft Kinect v2. Noise: Fankhauser et al., ICAR 2015, which gives no albedos, holes or correlations: the figures
// for those are this project's own, of the open driver's decoding (libfreenect2).
namespace dressform {
namespace {

ExpectedFigure within(double at, double value, double tolerance) {
  return {at, value, value - tolerance, value + tolerance};
}
ExpectedFigure percent(double at_deg, double value, double tolerance) {
  return {at_deg, value, value > tolerance ? value - tolerance : 0, value + tolerance};
}
ExpectedFigure within_part(double at, double value, double part) {
  return {at, value, (1 - part) * value, (1 + part) * value};
}

SensorDevice kinect_v2() {
  SensorDevice device;
  device.name = "kinect_v2";
  device.time_of_flight = true;
  device.ir_camera = {512, 424, 366, 366, 255.5, 211.5, {0.09, -0.27, 0, 0, 0.1}};
  device.noise = {{"Fankhauser 2015", fankhauser_sigma_mm, 0.15, 0.25}};
  device.noise_distances_m = {1, 2, 3, 4};
  device.noise_angles_deg = {60, 70, 80};
  device.noise_by_albedo_mm = {within_part(0.40, 3.3, 0.15), within_part(0.20, 5.6, 0.15), within_part(0.12, 9.3, 0.15),
                               within_part(0.05, 28.0, 0.25)};
  device.holes = {{0.05, {percent(0, 2, 2), percent(60, 46, 7), percent(75, 90, 5)}},
                  {0.12, {percent(0, 0, 0.1), percent(60, 0.5, 1), percent(75, 26, 6)}},
                  {0.20, {percent(0, 0, 0), percent(60, 0, 0.2), percent(75, 2, 2)}}};
  device.flying_pixels = {{0.2, 0.3, 0.2, 1.4}, {2.1, 2.4, 0.01, 0.24}};
  device.correlation = {within(1, 0.68, 0.05), within(2, 0.31, 0.05), within(3, 0, 0.06)};
  device.decoding_error_mm = 0.5;
  return device;
}

const DeviceDeclaration kinect_v2_device{kinect_v2()};

}  // namespace
}  // namespace dressform
