#include "scenes/devices/device.h"

#include <map>
#include <stdexcept>
#include <utility>

namespace dressform {
namespace {

std::map<std::string, SensorDevice>& devices() {
  static std::map<std::string, SensorDevice> map;
  return map;
}

}  // namespace

const PublishedNoise* SensorDevice::noise_by_angle() const {
  for (const auto& curve : noise)
    if (curve.knows_angle) return &curve;
  return nullptr;
}

const SensorDevice* find_device(const std::string& name) {
  const auto found = devices().find(name);
  return found == devices().end() ? nullptr : &found->second;
}

const SensorDevice* find_device(int width, int height) {
  for (const auto& [name, device] : devices())
    if (device.ir_camera.width == width && device.ir_camera.height == height) return &device;
  return nullptr;
}

DeviceDeclaration::DeviceDeclaration(SensorDevice device) {
  const std::string name = device.name;
  if (!devices().emplace(name, std::move(device)).second) throw std::logic_error("device " + name + " declared twice");
}

}  // namespace dressform
