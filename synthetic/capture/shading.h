#pragma once
#include "synthetic/capture/indirect_light.h"

namespace dressform {

// What shading needs of the world.
struct LitScene {
  const RayScene& scene;
  const Lighting& lighting;
  const IndirectLight& indirect;
};

// Sixteen hits, shaded: light that leaves them towards the eye is albedo * direct + other.
struct ShadedPacket {
  PointPacket points;            // valid: a diffuse hit
  Vector3f albedo[packet_size];  // linear RGB; zero for mirrors and misses
  Vector3f direct[packet_size];  // irradiance from the bulbs
  Vector3f other[packet_size];   // first bounce, ambient, highlights, lamps, mirror images
  int seen[packet_size];         // bit per bulb
};

// footprint_per_m: width of a sample at 1 m; bulb_sample: see `direct_light`. Chrome shows its surroundings once.
ShadedPacket shade(const LitScene& world, const RayPacket& rays, const HitPacket& hits, float footprint_per_m,
                   const int (&bulb_sample)[packet_size]);

}  // namespace dressform
