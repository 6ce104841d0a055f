#include "synthetic/sensors/noise_statistics.h"

#include <algorithm>
#include <cmath>

#include "synthetic/sensors/known_scenes.h"

namespace dressform {
namespace {

SensorFrame shoot(const SensorSetup& setup, const RayScene& scene, Seed seed = 1) {
  return measure_scene(scene, setup.model, setup.values, seed, 0, setup.camera);
}

// Adds up errors; positions and counts are whole, so that the order does not matter for them.
class ErrorSum {
 public:
  void add(int measured_mm, double true_mm) {
    if (measured_mm == 0) {
      ++holes_;
      return;
    }
    const double error = measured_mm - true_mm;
    sum_ += error, squares_ += error * error;
    worst_ = std::max(worst_, std::abs(error));
    ++count_;
  }
  DepthErrors result() const {
    DepthErrors errors;
    errors.pixels = count_;
    errors.worst_mm = worst_;
    errors.holes = count_ + holes_ > 0 ? static_cast<double>(holes_) / (count_ + holes_) : 0;
    errors.mean_mm = sum_ / std::max(1L, count_);
    errors.sigma_mm = std::sqrt(std::max(0.0, squares_ / std::max(1L, count_) - errors.mean_mm * errors.mean_mm));
    return errors;
  }

 private:
  double sum_ = 0, squares_ = 0, worst_ = 0;
  long count_ = 0, holes_ = 0;
};

}  // namespace

const SensorDevice& device_of(const std::string& model) {
  const SensorDevice* own = find_device(model);
  return own ? *own : *find_device(SensorModel::default_variant());
}

Camera usual_camera(const std::string& model) { return device_of(model).ir_camera; }

FieldValues those_it_has(const std::string& model, const FieldValues& values) {
  FieldValues result;
  for (const auto& field : SensorModel::at(model).fields)
    if (const auto value = values.find(field.name); value != values.end()) result.insert(*value);
  return result;
}

FieldValues noise_only(const std::string& model) {
  return those_it_has(
      model, {{"clip", 1.0}, {"multipath", 0.0}, {"interference_chance", 0.0}, {"warm_up_mm", 0.0}, {"ambient", 0.0}});
}

FieldValues without_noise(const std::string& model) {
  FieldValues values = those_it_has(model, {{"noise_scale", 0.0}, {"companding", false}, {"relief", 0.0}});
  values.merge(noise_only(model));
  return values;
}

DepthErrors plane_errors(const cv::Mat& depth_mm, const Camera& camera, double distance_m, double tilt_deg,
                         int half_width, int half_height) {
  ErrorSum sum;
  const int middle_x = camera.width / 2, middle_y = camera.height / 2;
  for (int y = middle_y - half_height; y < middle_y + half_height; ++y)
    for (int x = middle_x - half_width; x < middle_x + half_width; ++x)
      sum.add(depth_mm.at<std::uint16_t>(y, x), 1000 * true_plane_depth(camera, x, y, distance_m, tilt_deg));
  return sum.result();
}

DepthErrors of_plane(const SensorSetup& setup, double distance_m, double tilt_deg, float nir_albedo, Seed seed) {
  const SensorFrame frame = shoot(setup, scene_of(known_plane(distance_m, tilt_deg, nir_albedo)), seed);
  const int half_width = tilt_deg == 0 ? 24 : 3, half_height = tilt_deg == 0 ? 24 : 60;
  return plane_errors(frame.depth_mm, setup.camera, distance_m, tilt_deg, half_width, half_height);
}

DepthErrors of_plane_between_steps(const SensorSetup& setup, double distance_m, int seeds) {
  ErrorSum sum;
  const double step_m = 1e-3 * device_of(setup.model).step_mm(distance_m);
  for (int seed = 1; seed <= seeds; ++seed)
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const double z_m = distance_m + part * step_m;
      const SensorFrame frame = shoot(setup, scene_of(known_plane(z_m, 0, 0.9f)), static_cast<Seed>(seed));
      for (int y = 40; y < setup.camera.height - 40; y += 2)
        for (int x = 40; x < setup.camera.width - 40; x += 2)
          sum.add(frame.depth_mm.at<std::uint16_t>(y, x), 1000 * z_m);
    }
  return sum.result();
}

DepthErrors decoding_errors(const SensorSetup& setup, double distance_m) {
  const SensorFrame frame = shoot(setup, scene_of(known_plane(distance_m, 0, 0.8f)));
  ErrorSum sum;
  for (int y = 0; y < setup.camera.height; y += 3)
    for (int x = 0; x < setup.camera.width; x += 3) sum.add(frame.depth_mm.at<std::uint16_t>(y, x), 1000 * distance_m);
  return sum.result();
}

std::vector<double> noise_autocorrelation(const SensorSetup& setup, int lags) {
  const cv::Mat depth = shoot(setup, scene_of(known_plane(3, 0, kWhiteAlbedo))).depth_mm;
  const int middle_x = setup.camera.width / 2, middle_y = setup.camera.height / 2;
  std::vector<double> sums(lags + 1);
  for (int y = middle_y - 22; y < middle_y + 23; ++y)
    for (int x = middle_x - 56; x < middle_x + 44; ++x)
      for (int lag = 0; lag <= lags; ++lag)
        sums[lag] += (depth.at<std::uint16_t>(y, x) - 3000.0) * (depth.at<std::uint16_t>(y, x + lag) - 3000.0);
  for (int lag = lags; lag >= 0; --lag) sums[lag] /= sums[0];
  return sums;
}

double flying_pixels(const SensorSetup& setup, double gap_m) {
  const RayScene scene = plate_before_wall(gap_m);
  // Farther from both surfaces than six sigma of their noise.
  const double before_wall_mm = gap_m > 1 ? 60 : 25;
  const double rows = setup.camera.fy / 366.0;
  const int middle_x = setup.camera.width / 2, middle_y = setup.camera.height / 2;
  const int above = static_cast<int>(52 * rows), below = static_cast<int>(48 * rows),
            aside = static_cast<int>(156 * rows);
  constexpr int frames = 4;
  double flying = 0;
  for (int seed = 1; seed <= frames; ++seed) {
    const cv::Mat depth = shoot(setup, scene, static_cast<Seed>(seed)).depth_mm;
    for (int y = middle_y - above; y < middle_y + below; ++y)
      for (int x = middle_x - aside; x < middle_x + aside; ++x) {
        const int mm = depth.at<std::uint16_t>(y, x);
        flying += mm > 2025 && mm < 2000 + 1000 * gap_m - before_wall_mm;
      }
  }
  return flying / (2.0 * frames * (above + below));  // two edges in every row
}

std::map<double, double> wiggle_mm(const SensorSetup& setup) {
  std::map<double, double> curve;
  for (double distance_m = 0.7; distance_m <= 4.4; distance_m += 0.06)
    curve[distance_m] = of_plane(setup, distance_m, 0, 0.8f).mean_mm;
  return curve;
}

double peak_to_peak(const std::map<double, double>& curve) {
  double least = 1e9, most = -1e9;
  for (const auto& [at, value] : curve) least = std::min(least, value), most = std::max(most, value);
  return most - least;
}

std::set<int> depth_levels(const SensorSetup& setup, int from_mm, int to_mm) {
  SensorSetup all_dots = setup;
  all_dots.values.merge(those_it_has(setup.model, {{"least_signal", 0.0}}));
  const cv::Mat depth = shoot(all_dots, receding_floor()).depth_mm;
  std::set<int> levels;
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x)
      if (const int z = depth.at<std::uint16_t>(y, x); z >= from_mm && z <= to_mm) levels.insert(z);
  return levels;
}

}  // namespace dressform
