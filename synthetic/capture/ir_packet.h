#pragma once

namespace dressform {

constexpr int packet_size = 16;

// What sixteen rays of an infrared camera meet, side by side: for loops over lanes. Camera frame.
struct IrPacket {
  alignas(64) float ideal_x[packet_size], ideal_y[packet_size];  // of the ray: x/z, y/z
  alignas(64) float depth_m[packet_size];                        // along the optical axis; 0: nothing
  alignas(64) float normal_x[packet_size], normal_y[packet_size], normal_z[packet_size];  // unit, towards the camera
  alignas(64) float nir_albedo[packet_size];
  alignas(64) int chrome[packet_size];  // 0 or 1
};

}  // namespace dressform
