#include <cmath>

#include "scenes/devices/device.h"
#include "scenes/devices/noise.h"

// Microsoft Kinect v1 (PrimeSense's structured light). Noise: Khoshelham and Elberink, Sensors 2012; its growth with
// the angle: Nguyen, Izadi and Lovell, 3DIMPVT 2012. Levels: those of one unit, Gschwandtner et al., "BlenSor: Blender
// sensor simulation toolbox", ISVC 2011.
namespace dressform {
namespace {

double facing_mm(double z_m, double) { return khoshelham_sigma_mm(z_m); }

double step_mm(double z_m) { return 1e6 * z_m * z_m / 345489; }

// z = floor(1 / (1/1200 - n 0.1042/36000)).
std::set<int> levels_mm(int from_mm, int to_mm) {
  std::set<int> levels;
  for (int n = -2000; n < 280; ++n) {
    const double z = std::floor(1.0 / (1.0 / 1200 - n * 0.1042 / 36000));
    if (z >= from_mm && z <= to_mm) levels.insert(static_cast<int>(z));
  }
  return levels;
}

SensorDevice kinect_v1() {
  SensorDevice device;
  device.name = "kinect_v1";
  device.ir_camera = {640, 480, 580, 580, 319.5, 239.5, {}};
  device.noise = {{"Khoshelham 2012", facing_mm, 0.15, 0, false}, {"Nguyen 2012", nguyen_sigma_mm, 0, 0}};
  device.noise_distances_m = {1, 1.5, 2, 2.5, 3, 3.5};
  device.step_mm = step_mm;
  device.levels_mm = levels_mm;
  return device;
}

const DeviceDeclaration kinect_v1_device{kinect_v1()};

}  // namespace
}  // namespace dressform
