#pragma once
#include "synthetic/sensors/sensor_model.h"

namespace dressform {

// Parameters of the sensor model kinect_v2: kinect_v2.cpp says what they mean.
struct KinectV2Params {
  double signal = 1300, read_noise = 4, shot_noise = 0.1, relative_noise = 0.015, noise_scale = 1;
  double ambient = 10;
  bool companding = true;
  double relief = 0.08;
  double edge_gap_m = 0.01;
  double falloff = 3;
  double chrome_albedo = 0.005;
  double clip = 0.9;
  double multipath = 1;
  double interference_chance = 0.02, interference_leak = 0.05;
  double offset_mm = 0, offset_sigma_mm = 0;
  double warm_up_mm = 5, minutes_on = 60;
  bool bilateral = true, edge_filter = true;
  double minimum_m = 0.5, maximum_m = 4.5;
};

// Nine raw samples a pixel, decoded as the open driver (libfreenect2) decodes them. Pixels in rows on all threads; the
// same bytes for any number of them.
SensorFrame kinect_v2_frame(const IrView& view, const KinectV2Params& params, Seed seed);

}  // namespace dressform
