#include "synthetic/sensors/kinect_v2_frame.h"

// Kinect v2 in the phase domain: nine raw samples a pixel, decoded as the open driver decodes them, so that noise,
// flying pixels, holes and their correlations come out by themselves. Figures it is held to: scenes/devices. Fankhauser
// et al., "Kinect v2 for mobile robot navigation: evaluation and modeling", ICAR 2015. Driver: libfreenect2.
namespace dressform {

template <class V>
void fields(V& v, KinectV2Params& p) {
  v("signal", p.signal, 1.0, 1e5, "counts", "amplitude of a white surface that faces the camera at 1 m");
  v("read_noise", p.read_noise, 0.0, 100.0, "counts", "sigma of a raw sample in the dark");
  v("shot_noise", p.shot_noise, 0.0, 10.0, "counts", "variance of a raw sample per count of light");
  v("relative_noise", p.relative_noise, 0.0, 1.0, "", "sigma of a raw sample per count of its amplitude");
  v("noise_scale", p.noise_scale, 0.0, 10.0, "", "factor on the noise of the raw samples");
  v("ambient", p.ambient, 0.0, 1e5, "counts", "daylight and lamps: no signal, but shot noise");
  v("companding", p.companding, "raw samples are kept with 11 bits");
  v("relief", p.relief, 0.0, 1.0, "mm/m^1.5", "what relief, weave and crosstalk add at grazing incidence");
  v("edge_gap_m", p.edge_gap_m, 0.001, 0.5, "m", "least bend in depth between pixels for which a pixel is split in 16");
  v("falloff", p.falloff, 0.0, 8.0, "", "power of the cosine to the axis: lens (4) less the emitter's own profile");
  v("chrome_albedo", p.chrome_albedo, 0.0, 1.0, "", "albedo of chrome beside its glint, which saturates");
  v("clip", p.clip, 0.5, 1.0, "", "where the 16 MHz correlation is cut off (wiggling); 1: nowhere");
  v("multipath", p.multipath, 0.0, 2.0, "", "factor on light that bounces once on its way; 0: none");
  v("interference_chance", p.interference_chance, 0.0, 1.0, "",
    "part of the frames that another device's light disturbs");
  v("interference_leak", p.interference_leak, 0.0, 1.0, "", "amplitude of that light, in parts of the pixel's own");
  v("offset_mm", p.offset_mm, -100.0, 100.0, "mm", "mean over devices of an offset that the calibration does not know");
  v("offset_sigma_mm", p.offset_sigma_mm, 0.0, 100.0, "mm", "its deviation from device to device");
  v("warm_up_mm", p.warm_up_mm, -100.0, 100.0, "mm", "offset of a cold device; gone by e^-3 in half an hour");
  v("minutes_on", p.minutes_on, 0.0, 1e4, "min", "how long the device has been running");
  v("bilateral", p.bilateral, "the driver's joint bilateral filter");
  v("edge_filter", p.edge_filter, "the driver's edge filter");
  v("minimum_m", p.minimum_m, 0.0, 2.0, "m", "nearest depth that is measured");
  v("maximum_m", p.maximum_m, 1.0, 18.0, "m", "farthest depth that is measured");
}

namespace {

SensorFrame kinect_v2(const IrView& view, const KinectV2Params& params, Seed seed) {
  return kinect_v2_frame(view, params, seed);
}

const SensorModel::Variant kinect_v2_variant{"kinect_v2", kinect_v2};

}  // namespace
}  // namespace dressform
