#include "pipeline/landmarks/landmarks.h"

namespace dressform {
namespace {

// Of the length that the sum of the views' directions has to have: less is no agreement, but noise.
constexpr double kLeastSum = 0.3;

}  // namespace

std::optional<Vector3d> front_from_rig(const std::optional<RigPrior>& prior, const Registration& registration) {
  if (!prior) return {};
  Vector3d sum = Vector3d::Zero();
  for (const auto& [name, model_from_sensor] : registration.model_from_sensor) {
    const auto world_from_sensor = prior->world_from_sensor.find(name);
    if (world_from_sensor == prior->world_from_sensor.end()) continue;
    sum += model_from_sensor.linear() * world_from_sensor->second.linear().transpose() * Vector3d::UnitZ();
  }
  sum.y() = 0;
  if (sum.norm() < kLeastSum) return {};
  return Vector3d(sum.normalized());
}

}  // namespace dressform
