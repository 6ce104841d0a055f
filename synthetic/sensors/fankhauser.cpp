#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/devices/noise.h"
#include "scenes/random.h"
#include "synthetic/sensors/sensor_model.h"

// Kinect v2 after Fankhauser et al., "Kinect v2 for mobile robot navigation: evaluation and modeling", ICAR 2015, with
// the mixed pixels, holes and noise correlation that the driver leaves in its depth frames.
namespace dressform {
namespace {

struct FankhauserParams {
  double noise_scale = 1.0;
  bool correlated = true;
  double lateral_mm = 1.6;
  double minimum_m = 0.5, maximum_m = 4.5;
  double edge_gap_m = 0.03;
  double flying_near = 0.75, flying_far = 0.05, flying_gap_m = 0.8;
  double dropout_signal = 0.0055;
  double grazing_start_deg = 79, grazing_end_deg = 87;
  double chrome_hole = 0.97;
};

template <class V>
void fields(V& v, FankhauserParams& p) {
  v("noise_scale", p.noise_scale, 0.0, 10.0, "", "factor on the axial sigma");
  v("correlated", p.correlated,
    "neighbouring pixels share noise (autocorrelation .67/.33/0), as the driver's filter does");
  v("lateral_mm", p.lateral_mm, 0.0, 10.0, "mm", "sigma of where a contour is seen, across the ray");
  v("minimum_m", p.minimum_m, 0.0, 2.0, "m", "nearest depth that is measured");
  v("maximum_m", p.maximum_m, 1.0, 18.0, "m", "farthest depth that is measured");
  v("edge_gap_m", p.edge_gap_m, 0.005, 0.5, "m", "least depth step that mixes the two sides in one pixel");
  v("flying_near", p.flying_near, 0.0, 1.0, "",
    "part of the mixed pixels that survive the driver's filter, small gaps");
  v("flying_far", p.flying_far, 0.0, 1.0, "", "the same for large gaps");
  v("flying_gap_m", p.flying_gap_m, 0.05, 5.0, "m", "gap over which the survivors become fewer by e");
  v("dropout_signal", p.dropout_signal, 0.0, 0.1, "1/m^2",
    "albedo x cosine / r^2 at which half of the pixels are holes");
  v("grazing_start_deg", p.grazing_start_deg, 45.0, 90.0, "deg", "incidence at which holes begin whatever the albedo");
  v("grazing_end_deg", p.grazing_end_deg, 45.0, 90.0, "deg", "incidence at which all is holes");
  v("chrome_hole", p.chrome_hole, 0.0, 1.0, "", "part of the pixels on chrome that are holes");
}

// The curve has no end at 90 degrees: nothing was measured beyond 85.
double sigma_mm(double z_m, double theta_rad) { return fankhauser_sigma_mm(z_m, std::min(theta_rad, 1.48)); }

// Unit normal noise per pixel. A 3 x 3 box over white noise has autocorrelation 2/3, 1/3, 0 along a row.
class NoiseField {
 public:
  NoiseField(int width, int height, bool correlated, Seed seed)
      : correlated_(correlated), stride_((width + 2 + 3) / 4 * 4) {
    white_.resize(static_cast<std::size_t>(stride_) * (height + 2));
    tbb::parallel_for(0, height + 2, [&](int row) {
      for (int i = 0; i < stride_ / 4; ++i) {
        const std::size_t index = static_cast<std::size_t>(row) * (stride_ / 4) + i;
        const auto four = normal4(seed, stream_of("depth_noise"), index);
        for (int k = 0; k < 4; ++k) white_[4 * index + k] = static_cast<float>(four[k]);
      }
    });
  }
  float at(int x, int y) const {
    const float* centre = &white_[static_cast<std::size_t>(y + 1) * stride_ + x + 1];
    if (!correlated_) return *centre;
    float sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) sum += centre[dy * stride_ + dx];
    return sum / 3.0f;
  }

 private:
  bool correlated_;
  int stride_;
  std::vector<float> white_;
};

// What the pixel measures before noise: one surface, or a mixture of two.
struct Footprint {
  IrSample sample;
  bool lost = false;  // a mixture that the driver's filter rejects
};

class Model {
 public:
  Model(const IrView& view, const FankhauserParams& params, Seed seed)
      : view_(view),
        params_(params),
        seed_(seed),
        hits_(view.first_hits()),
        noise_(view.width(), view.height(), params.correlated, seed) {}

  SensorFrame frame() const {
    SensorFrame result{cv::Mat(view_.height(), view_.width(), CV_16UC1), cv::Mat()};
    if (view_.wants_infrared()) result.ir.create(view_.height(), view_.width(), CV_16UC1);
    tbb::parallel_for(0, view_.height(), [&](int y) {
      for (int x = 0; x < view_.width(); ++x) {
        const Footprint footprint = at_edge(x, y) ? mixed(x, y) : Footprint{hit(x, y)};
        result.depth_mm.at<std::uint16_t>(y, x) = measure(footprint, x, y);
        if (view_.wants_infrared()) result.ir.at<std::uint16_t>(y, x) = infrared(footprint.sample, x, y);
      }
    });
    return result;
  }

 private:
  const IrSample& hit(int x, int y) const { return hits_[static_cast<std::size_t>(y) * view_.width() + x]; }
  std::uint64_t index(int x, int y) const { return static_cast<std::uint64_t>(y) * view_.width() + x; }

  // Whether a step in depth lies within a pixel's reach. The second difference is blind to slope: a floor is no edge.
  bool at_edge(int x, int y) const {
    const int left = std::max(0, x - 1), right = std::min(view_.width() - 1, x + 1);
    const int above = std::max(0, y - 1), below = std::min(view_.height() - 1, y + 1);
    const float twice = 2 * hit(x, y).depth_m;
    const float gap_m = static_cast<float>(params_.edge_gap_m);
    return std::abs(hit(left, y).depth_m + hit(right, y).depth_m - twice) > gap_m ||
           std::abs(hit(x, above).depth_m + hit(x, below).depth_m - twice) > gap_m ||
           std::abs(hit(left, above).depth_m + hit(right, below).depth_m - twice) > gap_m ||
           std::abs(hit(right, above).depth_m + hit(left, below).depth_m - twice) > gap_m;
  }

  // 4 x 4 rays over the pixel, moved by the lateral noise, split at the widest step in depth. The nearer and the
  // farther side count by the light that they send back.
  Footprint mixed(int x, int y) const {
    std::array<IrSample, packet_size> samples = subsamples(x, y);
    std::stable_sort(samples.begin(), samples.end(),
                     [](const IrSample& a, const IrSample& b) { return a.depth_m < b.depth_m; });
    int split = 0;
    float gap_m = 0;
    for (int i = 1; i < packet_size; ++i)
      if (samples[i].depth_m - samples[i - 1].depth_m > gap_m)
        gap_m = samples[i].depth_m - samples[i - 1].depth_m, split = i;
    if (gap_m < params_.edge_gap_m) return {hit(x, y)};
    float light_near = 0, light_far = 0;
    const IrSample nearer = mean(&samples[0], split, light_near);
    const IrSample farther = mean(&samples[split], packet_size - split, light_far);
    const float total = light_near + light_far;
    const float share = total > 0 ? light_near / total : 0.5f;
    if (share > 0.85f) return {nearer};
    if (share < 0.15f) return {farther};
    const double survivors =
        params_.flying_far + (params_.flying_near - params_.flying_far) * std::exp(-gap_m / params_.flying_gap_m);
    Footprint result{nearer, uniform(seed_, stream_of("flying"), index(x, y)) > survivors};
    result.sample.depth_m = share * nearer.depth_m + (1 - share) * farther.depth_m;
    result.sample.distance_m = share * nearer.distance_m + (1 - share) * farther.distance_m;
    result.sample.nir_albedo = share * nearer.nir_albedo + (1 - share) * farther.nir_albedo;
    return result;
  }

  std::array<IrSample, packet_size> subsamples(int x, int y) const {
    const auto random = normal4(seed_, stream_of("lateral"), index(x, y));
    const float sigma_px =
        static_cast<float>(params_.lateral_mm * 1e-3 * view_.camera().fx / std::max(0.5f, hit(x, y).depth_m));
    const float shift_x = std::clamp(static_cast<float>(random[0]) * sigma_px, -0.6f, 0.6f);
    const float shift_y = std::clamp(static_cast<float>(random[1]) * sigma_px, -0.6f, 0.6f);
    std::array<Vector2f, packet_size> pixels;
    for (int i = 0; i < packet_size; ++i)
      pixels[i] = {std::clamp(x + shift_x + (i % 4 - 1.5f) / 4, -1.0f, static_cast<float>(view_.width())),
                   std::clamp(y + shift_y + (i / 4 - 1.5f) / 4, -1.0f, static_cast<float>(view_.height()))};
    std::array<IrSample, packet_size> samples;
    view_.trace(pixels.data(), packet_size, samples.data());
    for (auto& sample : samples)
      if (sample.depth_m <= 0) sample.depth_m = 30.0f, sample.distance_m = 30.0f, sample.cos_incidence = 1;
    return samples;
  }

  static IrSample mean(const IrSample* samples, int count, float& light) {
    IrSample sum = samples[0];
    for (int i = 1; i < count; ++i) {
      sum.depth_m += samples[i].depth_m;
      sum.distance_m += samples[i].distance_m;
      sum.cos_incidence += samples[i].cos_incidence;
      sum.nir_albedo += samples[i].nir_albedo;
      sum.chrome = sum.chrome || samples[i].chrome;
    }
    for (int i = 0; i < count; ++i)
      light += samples[i].nir_albedo * samples[i].cos_incidence / (samples[i].distance_m * samples[i].distance_m);
    sum.depth_m /= count, sum.distance_m /= count, sum.cos_incidence /= count, sum.nir_albedo /= count;
    return sum;
  }

  std::uint16_t measure(const Footprint& footprint, int x, int y) const {
    const IrSample& sample = footprint.sample;
    if (footprint.lost || sample.depth_m <= 0) return 0;
    const double theta = std::acos(std::clamp(sample.cos_incidence, 0.0f, 1.0f));
    if (hole(sample, theta, x, y)) return 0;
    const double noise_m = 1e-3 * params_.noise_scale * sigma_mm(sample.depth_m, theta) * noise_.at(x, y);
    return depth_in_mm(sample.depth_m + noise_m, view_.depth_offset_m(), params_.minimum_m, params_.maximum_m);
  }

  // Too little light comes back, the surface is seen from its edge, or it is a mirror.
  bool hole(const IrSample& sample, double theta, int x, int y) const {
    if (sample.chrome) return uniform(seed_, stream_of("chrome"), index(x, y)) < params_.chrome_hole;
    const double signal = sample.nir_albedo * sample.cos_incidence / (sample.distance_m * sample.distance_m);
    const double ratio = params_.dropout_signal > 0 ? signal / params_.dropout_signal : 1e6;
    const double too_dark = 1 / (1 + ratio * ratio * ratio * ratio * ratio);
    const double span_deg = std::max(1e-3, params_.grazing_end_deg - params_.grazing_start_deg);
    const double too_flat = (theta * 180 / M_PI - params_.grazing_start_deg) / span_deg;
    if (too_dark < 1e-6 && too_flat <= 0) return false;
    const auto random = uniform4(seed_, stream_of("holes"), index(x, y));
    return random[0] < too_dark || random[1] < too_flat;
  }

  std::uint16_t infrared(const IrSample& sample, int x, int y) const {
    const float cos_axis = sample.depth_m > 0 ? sample.depth_m / sample.distance_m : 1.0f;
    const double counts = ir_counts(sample, cos_axis) / 16;
    const double variance = 16 + 0.1 * counts + std::pow(0.015 * counts, 2);  // sensors.md: r^2 + k A + (m A)^2
    const double noise = std::sqrt(variance / 6) * normal(seed_, stream_of("ir"), index(x, y));
    return cv::saturate_cast<std::uint16_t>(std::max(0.0, 16 * (counts + noise)));
  }

  const IrView& view_;
  const FankhauserParams& params_;
  Seed seed_;
  std::vector<IrSample> hits_;
  NoiseField noise_;
};

SensorFrame fankhauser(const IrView& view, const FankhauserParams& params, Seed seed) {
  return Model(view, params, seed).frame();
}

const SensorModel::Variant fankhauser_variant{"fankhauser", fankhauser};

}  // namespace
}  // namespace dressform
