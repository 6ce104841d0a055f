#pragma once
#include "synthetic/capture/light.h"

namespace dressform {

// Irradiance of the first bounce and of the ambient term at every vertex (outer side), per surface. Gathered at a few
// thousand places over directions that are the same everywhere, and blended between them: smooth, without grain.
class IndirectLight {
 public:
  IndirectLight(const RayScene& scene, const Lighting& lighting);
  // Interpolated at a hit. From behind (inside of cloth) half of it.
  Vector3f irradiance(const RayScene& scene, const RayPacket& rays, const HitPacket& hits, int lane) const;

 private:
  std::vector<std::vector<Vector3f>> per_vertex_;
};

}  // namespace dressform
