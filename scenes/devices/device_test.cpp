#include "scenes/devices/device.h"

#include <gtest/gtest.h>

#include "scenes/devices/noise.h"

namespace dressform {
namespace {

TEST(Devices, AreFoundByNameAndByImageSize) {
  const SensorDevice* device = find_device("kinect_v2");
  ASSERT_NE(device, nullptr);
  EXPECT_TRUE(device->time_of_flight);
  EXPECT_EQ(find_device(512, 424), device);
  ASSERT_NE(find_device(640, 480), nullptr);
  EXPECT_EQ(find_device(640, 480)->name, "kinect_v1");
  for (const char* unknown : {"", "primesense", "Kinect_v2"}) EXPECT_EQ(find_device(unknown), nullptr) << unknown;
  EXPECT_EQ(find_device(424, 512), nullptr);
}

TEST(Devices, ANameIsTakenOnce) {
  SensorDevice device;
  device.name = "kinect_v1";
  EXPECT_THROW(DeviceDeclaration{device}, std::logic_error);
}

// A device declared anywhere is known everywhere: here is the whole of what a stranger writes.
TEST(Devices, ADeclarationIsAllItTakes) {
  SensorDevice device;
  device.name = "test_device";
  device.time_of_flight = true;
  device.ir_camera = {17, 13, 9, 9, 8, 6, {}};
  static const DeviceDeclaration declaration{device};
  ASSERT_NE(find_device("test_device"), nullptr);
  EXPECT_EQ(find_device(17, 13), find_device("test_device"));
  EXPECT_EQ(find_device("test_device")->noise_by_angle(), nullptr);
}

TEST(Devices, LevelsOfOneKinectV1) {
  const SensorDevice& device = *find_device("kinect_v1");
  const auto levels = device.levels_mm(1000, 4000);
  EXPECT_EQ(levels.size(), 259u);
  EXPECT_EQ(levels.count(1200), 1u);  // n = 0
  EXPECT_NEAR(device.step_mm(2), 11.58, 0.01);
}

TEST(Devices, PublishedNoise) {
  EXPECT_NEAR(fankhauser_sigma_mm(2, 0), 1.7, 1e-12);
  EXPECT_NEAR(fankhauser_sigma_mm(2, M_PI / 4), 1.7 + 0.2 * std::sqrt(2.0), 1e-12);  // slope 1
  EXPECT_NEAR(khoshelham_sigma_mm(2), 5.7, 1e-12);
  EXPECT_NEAR(nguyen_sigma_mm(1.4, 0), 3.1, 1e-12);
  EXPECT_EQ(find_device("kinect_v1")->noise_by_angle()->name, "Nguyen 2012");
  EXPECT_EQ(find_device("kinect_v2")->noise_by_angle()->name, "Fankhauser 2015");
}

}  // namespace
}  // namespace dressform
