#pragma once
#include "synthetic/sensors/noise_statistics.h"
#include "synthetic/sensors/test_scenes.h"

// Kinect v2 in full size, with its noise or what moves the mean alone, for its tests.
namespace dressform::kinect_v2_scenes {

using namespace test_scenes;

inline Camera full_size_v2() { return usual_camera("kinect_v2"); }

inline FieldValues with_more(FieldValues values, const FieldValues& more) {
  for (const auto& [name, value] : more) values[name] = value;
  return values;
}
// Noise alone: what moves the mean is off.
inline FieldValues noise_only_v2(const FieldValues& more = {}) {
  return with_more(dressform::noise_only("kinect_v2"), more);
}
// What moves the mean, alone.
inline FieldValues noiseless_v2(const FieldValues& more = {}) { return with_more(without_noise("kinect_v2"), more); }

inline SensorSetup v2_setup(const FieldValues& values = noise_only_v2()) {
  return {"kinect_v2", values, full_size_v2()};
}

inline SensorFrame shoot_v2(const RayScene& scene, const FieldValues& values, Seed seed = 1) {
  return measure(scene, "kinect_v2", values, seed, 0, full_size_v2());
}

}  // namespace dressform::kinect_v2_scenes
