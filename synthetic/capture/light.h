#pragma once
#include <vector>

#include "scenes/scene.h"
#include "synthetic/capture/ray_scene.h"

namespace dressform {

// Bulbs, and what the room sends back. Irradiance is in the lights' own unit: a bulb of intensity I gives I / d^2.
struct Lighting {
  std::vector<LightSpec> bulbs;
  Vector3f ambient_rgb = Vector3f::Zero();  // beyond the first bounce: a closed room seen as an integrating sphere
};
Lighting make_lighting(const std::vector<LightSpec>& lights, const RoomSpec& room);

// Direct irradiance (RGB) at sixteen points through one shadow ray a bulb. `sample` picks the spot on each bulb: 0 to
// bulb_samples - 1 cover it evenly. Lanes without a point stay zero.
constexpr int bulb_samples = 16;
struct PointPacket {
  bool valid[packet_size] = {};
  Vector3f position[packet_size], normal[packet_size], geometric_normal[packet_size];
};
struct DirectLight {
  Vector3f irradiance[packet_size];  // all bulbs
  Vector3f highlight[packet_size];   // for gloss: sum over bulbs of irradiance times (n.h)^exponent
  int seen[packet_size];             // bit per bulb that was seen, to tell penumbras
};
DirectLight direct_light(const RayScene& scene, const Lighting& lighting, const PointPacket& points,
                         const Vector3f (&eye)[packet_size], const float (&gloss_exponent)[packet_size],
                         const int (&sample)[packet_size], Coherence coherence);

// The linear gain that puts a white surface (albedo 0.9) at the mannequin, turned to where most light comes from, just
// below full scale; mid-grey that faces a camera then lands mid-scale in sRGB.
float nominal_exposure(const Lighting& lighting);

}  // namespace dressform
