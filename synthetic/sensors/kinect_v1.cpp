#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "scenes/random.h"
#include "synthetic/sensors/sensor_model.h"

// Kinect v1: a pattern of dots, thrown from beside the camera and found again by matching windows. Shadows of the
// projector, disparities in steps of an eighth of a pixel, and the ladder of depths that one real unit delivers. Noise:
// Khoshelham and Elberink, "Accuracy and resolution of Kinect depth data", Sensors 2012; its growth with the angle:
// Nguyen, Izadi and Lovell, "Modeling Kinect sensor noise", 3DIMPVT 2012. Matching: Gschwandtner et al., "BlenSor",
// ISVC 2011.
namespace dressform {
namespace {

struct KinectV1Params {
  double baseline_m = 0.075;
  double noise_scale = 1;
  int support_px = 9;
  double least_support = 0.5;
  double least_signal = 0.004;
  int ir_shift_x_px = 0, ir_shift_y_px = 0;
  double minimum_m = 0.5, maximum_m = 8;
};

template <class V>
void fields(V& v, KinectV1Params& p) {
  v("baseline_m", p.baseline_m, -0.5, 0.5, "m", "from the camera to the projector, along x; casts the shadows");
  v("noise_scale", p.noise_scale, 0.0, 10.0, "", "factor on the noise of the disparity");
  v("support_px", p.support_px, 1, 31, "px", "edge of the window that is matched");
  v("least_support", p.least_support, 0.0, 1.0, "", "part of the window that must show dots");
  v("least_signal", p.least_signal, 0.0, 1.0, "1/m^2", "albedo x cosine / r^2 below which dots are not seen");
  v("ir_shift_x_px", p.ir_shift_x_px, -20, 20, "px",
    "the raw infrared image lies this far to the right of the depth's (5)");
  v("ir_shift_y_px", p.ir_shift_y_px, -20, 20, "px", "and this far below it (4)");
  v("minimum_m", p.minimum_m, 0.0, 2.0, "m", "nearest depth that is measured");
  v("maximum_m", p.maximum_m, 1.0, 20.0, "m", "farthest depth that is measured");
}

// One unit's ladder, in steps of an eighth of a pixel of disparity: z = 1 / (1/1200 - n 0.1042/36000) mm.
constexpr double nearest_inverse = 1.0 / 1200, inverse_step = 0.1042 / 36000;
double steps_at(double depth_mm) { return (nearest_inverse - 1 / depth_mm) / inverse_step; }
int ladder_mm(int steps) {
  const double inverse = nearest_inverse - steps * inverse_step;
  return inverse > 1e-5 ? static_cast<int>(std::floor(1 / inverse)) : 0;
}

// sigma_z = 1.425e-3 z^2 m is this many steps at every distance; the steps' own width is part of it.
double sigma_steps() {
  const double total = 1.425e-6 / inverse_step;
  return std::sqrt(total * total - 1.0 / 12);
}

// An image of this shape, at whatever resolution the whole scene is rendered.
void check_shape(const IrView& view) {
  if (3 * view.width() == 4 * view.height()) return;
  throw InputError("sensor kinect_v1", "found an infrared camera of " + std::to_string(view.width()) + " x " +
                                           std::to_string(view.height()) +
                                           "; expected 640 x 480 (or that, scaled), as in rigs/kinect_v1.toml");
}

class KinectV1 {
 public:
  KinectV1(const IrView& view, const KinectV1Params& params, Seed seed)
      : view_(view), params_(params), seed_(seed), width_(view.width()), height_(view.height()) {}

  SensorFrame frame() const {
    const std::vector<IrSample> seen = view_.first_hits();
    const cv::Mat lit = find_lit(seen);
    const cv::Mat disparity = match(disparities(seen, lit));
    SensorFrame result{quantised(disparity, seen), cv::Mat()};
    if (view_.wants_infrared()) result.ir = infrared(seen, lit);
    return result;
  }

 private:
  const IrSample& at(const std::vector<IrSample>& seen, int x, int y) const {
    return seen[static_cast<std::size_t>(y) * width_ + x];
  }
  Vector3f point(const IrSample& sample, int x, int y) const {
    const Vector2f& ideal = view_.ideal(x, y);
    return {sample.depth_m * ideal.x(), sample.depth_m * ideal.y(), sample.depth_m};
  }

  // 255 where the projector's light falls on what the pixel sees: a ray from the projector to the point.
  cv::Mat find_lit(const std::vector<IrSample>& seen) const {
    cv::Mat lit(height_, width_, CV_8UC1);
    const Eigen::Isometry3f world_from_sensor = view_.world_from_sensor().cast<float>();
    const Vector3f projector = world_from_sensor * Vector3f(static_cast<float>(params_.baseline_m), 0, 0);
    tbb::parallel_for(0, height_, [&](int y) {
      for (int left = 0; left < width_; left += packet_size) {
        RayPacket rays;
        const int count = std::min(packet_size, width_ - left);
        for (int lane = 0; lane < count; ++lane) {
          const IrSample& sample = at(seen, left + lane, y);
          if (sample.depth_m <= 0) continue;
          const Vector3f way = world_from_sensor * point(sample, left + lane, y) - projector;
          rays.set(lane, projector, way, 0.2f / std::max(0.21f, way.norm()), 0.998f);
        }
        bool hidden[packet_size];
        view_.scene().occluded(rays, hidden, Coherence::coherent);
        for (int lane = 0; lane < count; ++lane)
          lit.at<std::uint8_t>(y, left + lane) = rays.valid[lane] && !hidden[lane] ? 255 : 0;
      }
    });
    return lit;
  }

  // Steps; NaN where no dots are seen.
  cv::Mat disparities(const std::vector<IrSample>& seen, const cv::Mat& lit) const {
    cv::Mat result(height_, width_, CV_32FC1);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const IrSample& sample = at(seen, x, y);
        const float signal = sample.nir_albedo * sample.cos_incidence / (sample.distance_m * sample.distance_m);
        const bool dots = lit.at<std::uint8_t>(y, x) && !sample.chrome && signal >= params_.least_signal;
        result.at<float>(y, x) = dots ? static_cast<float>(steps_at(1000.0 * sample.depth_m)) : NAN;
      }
    return result;
  }

  // A window is matched as a whole: its disparity is that of the surface that fills most of it, and there is none where
  // too little of it shows dots.
  cv::Mat match(const cv::Mat& disparity) const {
    cv::Mat result(height_, width_, CV_32FC1);
    const int reach = params_.support_px / 2;
    tbb::parallel_for(0, height_, [&](int y) {
      std::vector<float> window;
      for (int x = 0; x < width_; ++x) {
        window.clear();
        const int top = std::max(0, y - reach), bottom = std::min(height_ - 1, y + reach);
        const int left = std::max(0, x - reach), right = std::min(width_ - 1, x + reach);
        for (int v = top; v <= bottom; ++v)
          for (int u = left; u <= right; ++u)
            if (const float value = disparity.at<float>(v, u); !std::isnan(value)) window.push_back(value);
        const double needed = params_.least_support * (bottom - top + 1) * (right - left + 1);
        result.at<float>(y, x) = !window.empty() && window.size() >= needed ? dominant(window) : NAN;
      }
    });
    return result;
  }

  // Mean of the values, or of the larger group where they fall apart into two.
  static float dominant(const std::vector<float>& window) {
    constexpr float apart = 16;  // steps: two pixels
    const auto [least, most] = std::minmax_element(window.begin(), window.end());
    const float middle = 0.5f * (*least + *most);
    const bool split = *most - *least > apart;
    double sum[2] = {};
    int count[2] = {};
    for (const float value : window) {
      const int group = split && value > middle;
      sum[group] += value;
      ++count[group];
    }
    const int larger = count[1] > count[0];
    return static_cast<float>(sum[larger] / count[larger]);
  }

  // Unit normal noise; neighbours share it as they share their windows.
  cv::Mat noise() const {
    const int reach = params_.support_px / 2, columns = width_ + 2 * reach, rows = height_ + 2 * reach;
    const int blocks = (columns * rows + normal_block - 1) / normal_block;
    std::vector<float> white(static_cast<std::size_t>(blocks) * normal_block);
    fill_normals(seed_, stream_of("disparity"), 0, blocks, white.data());
    cv::Mat shared;
    cv::boxFilter(cv::Mat(rows, columns, CV_32FC1, white.data()), shared, CV_32F, {2 * reach + 1, 2 * reach + 1},
                  {-1, -1}, false);
    return shared(cv::Rect(reach, reach, width_, height_)) / (2 * reach + 1);
  }

  // Sigma in steps, at a depth and an angle.
  static double sigma(const IrSample& sample) {
    const double theta = std::min(1.5, std::acos(std::min(1.0, static_cast<double>(sample.cos_incidence))));
    const double ratio = theta / (M_PI / 2 - theta), z = std::max(0.3f, sample.depth_m);
    const double slanted_mm = 0.1 / std::sqrt(z) * ratio * ratio, step_mm = 1e6 * z * z * inverse_step;
    return std::hypot(sigma_steps(), slanted_mm / step_mm);
  }

  cv::Mat quantised(const cv::Mat& disparity, const std::vector<IrSample>& seen) const {
    const cv::Mat unit_noise = noise();
    cv::Mat depth(height_, width_, CV_16UC1);
    const double least = 1000 * params_.minimum_m, most = 1000 * params_.maximum_m;
    tbb::parallel_for(0, height_, [&](int y) {
      for (int x = 0; x < width_; ++x) {
        const float steps = disparity.at<float>(y, x);
        int depth_mm = 0;
        if (!std::isnan(steps)) {
          const double noisy = steps + params_.noise_scale * sigma(at(seen, x, y)) * unit_noise.at<float>(y, x);
          depth_mm = ladder_mm(static_cast<int>(std::floor(noisy + 0.5)));
        }
        const bool good = depth_mm > 0 && depth_mm >= least && depth_mm <= most;
        depth.at<std::uint16_t>(y, x) =
            good ? static_cast<std::uint16_t>(std::max(0.0, std::round(depth_mm + 1000 * view_.depth_offset_m()))) : 0;
      }
    });
    return depth;
  }

  // Dots where the projector's rays carry them, ten bits; the projector's shadow is dark.
  cv::Mat infrared(const std::vector<IrSample>& seen, const cv::Mat& lit) const {
    cv::Mat image(height_, width_, CV_16UC1, cv::Scalar(0));
    const double focal_px = view_.camera().fx;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const int to_x = x + params_.ir_shift_x_px, to_y = y + params_.ir_shift_y_px;
        const IrSample& sample = at(seen, x, y);
        if (to_x < 0 || to_y < 0 || to_x >= width_ || to_y >= height_ || sample.depth_m <= 0) continue;
        const Vector3f p = point(sample, x, y);
        const auto dot_x = static_cast<std::int64_t>(std::floor((p.x() - params_.baseline_m) / p.z() * focal_px / 2));
        const auto dot_y = static_cast<std::int64_t>(std::floor(p.y() / p.z() * focal_px / 2));
        const double dot = uniform(0, stream_of("dots"), static_cast<std::uint64_t>(dot_y * 65536 + dot_x)) < 0.2;
        const double light = lit.at<std::uint8_t>(y, x) ? 0.2 + 3 * dot : 0.05;
        const double counts = light * ir_counts(sample, sample.depth_m / sample.distance_m) / 16;
        image.at<std::uint16_t>(to_y, to_x) = static_cast<std::uint16_t>(64 * std::min(1023.0, std::round(counts)));
      }
    return image;
  }

  const IrView& view_;
  const KinectV1Params& params_;
  Seed seed_;
  int width_, height_;
};

SensorFrame kinect_v1(const IrView& view, const KinectV1Params& params, Seed seed) {
  check_shape(view);
  return KinectV1(view, params, seed).frame();
}

const SensorModel::Variant kinect_v1_variant{"kinect_v1", kinect_v1};

}  // namespace
}  // namespace dressform
