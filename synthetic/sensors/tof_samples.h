#pragma once
#include "synthetic/capture/ir_packet.h"

// The forward half of a Kinect v2: from what its rays meet to the nine raw samples of every pixel, three phases at each
// of three modulation frequencies. Plain arrays, one value a point; lengths of light paths in millimetres from the
// emitter to the surface and back to the lens; amplitudes in counts.
namespace dressform::tof {

constexpr int frequencies = 3;  // 80, 16, 120 MHz
constexpr int raw_samples = 9;  // sample 3 f + k: frequency f, phase 2 pi k / 3
// Of the modulation. The driver's constants mean a speed of light of 3e8 m/s; what the crystal's true frequency makes
// of it is a matter of calibration.
constexpr float wavelength_mm[frequencies] = {3750.0f, 18750.0f, 2500.0f};
constexpr float contrast[frequencies] = {1 / 1.322581f, 1.0f, 1 / 1.612903f};
constexpr float emitter_x_mm = 45.0f;  // to the right of the lens

// The emitter, the lens, and what surfaces do beyond a smooth matt plane.
struct Lamp {
  float signal_at_1m;   // counts from a white surface that faces the camera at 1 m on the axis
  float falloff;        // exponent of the cosine to the axis: the lens' four less what the emitter sends outwards
  float chrome_albedo;  // of chrome away from its glint
  float relief;         // see below
};

// What comes back from sixteen points.
struct Returned {
  alignas(64) float path_mm[packet_size];
  alignas(64) float direct[packet_size];  // amplitude straight from the emitter; 0: nothing there
  alignas(64) float gain[packet_size];    // amplitude per unit of light that other surfaces throw on the point
  // Sigma of the path: at grazing incidence relief, weave and crosstalk between pixels move the centre of the light
  // about over the pixel's long footprint, the same for all frequencies. relief * z^1.5 theta^2 / (pi/2 - theta)^2 mm
  // in depth, the angular term of Fankhauser et al. 2015, before the filter that divides it by about three.
  alignas(64) float relief_mm[packet_size];
};
void illuminate(const IrPacket& packet, const Lamp& lamp, Returned& out);

constexpr int bounce_terms = 7;  // cos, sin at each frequency, relative to the direct path; then the plain sum

struct Points {
  const float *path_mm, *direct, *gain;
  const float* bounce[bounce_terms];
};

// What all pixels of a frame suffer alike.
struct FrameErrors {
  float clip = 1;                        // the 16 MHz correlation is cut at +-clip: wiggling
  float interference[raw_samples] = {};  // what another device's light adds, in units of the pixel's own amplitude
};

// Noiseless samples of n points, and the light that makes them: the sum of amplitudes.
void expose(const Points& points, const FrameErrors& errors, int n, float* const (&samples)[raw_samples], float* light);

struct Electronics {
  float noise_scale = 1;
  float read_variance = 16, shot = 0.1f, relative = 0.015f;  // variance: read + shot (A + ambient) + (relative A)^2
  float ambient = 0;                                         // counts
  bool companding = true;                                    // 11 bits, steps that grow with the value
};
constexpr float full_scale = 16320;  // counts; a sample there is saturated

// Phasors of a row as the driver first sees them: unit vector and amplitude per frequency; amplitude 0 and a null
// vector where there is nothing, amplitude -1 where a sample of any frequency is saturated.
struct PhasorRow {
  float *cosine[frequencies], *sine[frequencies], *amplitude[frequencies];
};

// Adds noise to n x 9 samples (normals[s n + i] for sample s of point i), stores them with 11 bits, and brings each
// triple back to a phasor (step 1 of the driver).
void read_out(const float* const (&samples)[raw_samples], const float* light, const float* normals,
              const Electronics& electronics, int n, const PhasorRow& out);

}  // namespace dressform::tof
