#include "pipeline/multipath/bounce_pixels.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr float kOneSurface = 0.05f;   // largest step in depth from a pixel to its cell, in parts of the depth
constexpr double kOneSlope = 0.025;    // the same to a neighbouring pixel
constexpr double kNormalSigma = 0.15;  // of a normal from depth, rad
constexpr double kAlbedoSigma = 0.15;  // of a pixel's albedo about that of its surroundings, natural logarithm
constexpr double kDarkest = 0.05;      // direct light, in parts of what a surface facing the emitter gets
constexpr std::uint16_t kSaturated = 65535;
constexpr double kLeastSpread = 1e-2;  // of the neighbours' rays across, over along: those in one line have no slope
constexpr float kLeastShare = 1e-3f;   // of a cell among four: so that one is never divided by nothing
constexpr int kNormalSteps = 256;      // in an image's width between the pixels that a normal is taken from

// Mean of amplitude over light: the albedo of every cell and its neighbours of the same surface. Those that face the
// emitter know it best. 0 where it is not known.
std::vector<float> surrounding_albedo(const SurfaceCells& cells, const BouncedLight& light, double signal_counts) {
  std::vector<float> amplitude(cells.count(), 0.0f), lit(cells.count(), 0.0f), result(cells.count(), 0.0f);
  for (int i = 0; i < cells.count(); ++i) {
    if (cells.z[i] == 0) continue;
    const double x = cells.x[i], y = cells.y[i], z = cells.z[i];
    const double cosine =
        std::max(kLeastLitCosine, lit_cosine(x, y, z, {cells.normal_x[i], cells.normal_y[i], cells.normal_z[i]}));
    const double weight = cosine * cosine;
    amplitude[i] = static_cast<float>(weight * cells.ir_counts[i] * light_per_count(x, y, z, signal_counts));
    lit[i] = static_cast<float>(
        weight * (direct_light(x, y, z, cosine) + (light.term(0)[i] + light.term(2)[i] + light.term(4)[i]) / 3));
  }
  for (int y = 0; y < cells.rows; ++y)
    for (int x = 0; x < cells.columns; ++x) {
      const int i = y * cells.columns + x;
      if (cells.z[i] == 0) continue;
      float sum = 0, weights = 0;
      for (int v = std::max(0, y - 1); v <= std::min(cells.rows - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(cells.columns - 1, x + 1); ++u) {
          const int k = v * cells.columns + u;
          if (cells.z[k] == 0 || std::abs(cells.z[k] - cells.z[i]) > kOneSurface * cells.z[i]) continue;
          sum += amplitude[k], weights += lit[k];
        }
      result[i] = weights > 0 ? sum / weights : 0;
    }
  return result;
}

// What a pixel has from the four cells about it that are of its surface.
struct Surroundings {
  float bounced[BouncedLight::terms] = {}, albedo = 0;
  bool known = false;
};

class Pixels {
 public:
  Pixels(const cv::Mat& depth_mm, const SurfaceCells& cells, const BouncedLight& light, const PixelLight& pixels,
         const DepthOptics& optics)
      : depth_mm_(depth_mm),
        cells_(cells),
        light_(light),
        pixels_(pixels),
        optics_(optics),
        step_px_(std::max(1, (depth_mm.cols + kNormalSteps / 2) / kNormalSteps)) {
    if (!pixels.ir.empty()) albedo_ = surrounding_albedo(cells, light, pixels.signal_counts);
  }

  // Metres; the pixel has depth.
  double error_m(int u, int v) const {
    const double z = depth_m(u, v);
    if (z <= 0) return 0;
    const Surroundings about = surroundings(u, v, static_cast<float>(z));
    if (!about.known) return 0;
    const auto& ray = optics_.rays.at<cv::Vec2d>(v, u);
    const double x = ray[0] * z, y = ray[1] * z;
    return bounce_error_m(direct(u, v, x, y, z, about), about.bounced, std::hypot(ray[0], ray[1], 1));
  }

 private:
  double depth_m(int u, int v) const {
    return 1e-3 * depth_mm_.at<std::uint16_t>(v, u) - optics_.calibration.depth_offset_m;
  }

  Surroundings surroundings(int u, int v, float z) const {
    const float x = (u + 0.5f) / cells_.edge_px - 0.5f, y = (v + 0.5f) / cells_.edge_px - 0.5f;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    Surroundings result;
    float weights = 0;
    for (int k = 0; k < 4; ++k) {
      const int column = left + k % 2, row = top + k / 2;
      if (column < 0 || row < 0 || column >= cells_.columns || row >= cells_.rows) continue;
      const int i = row * cells_.columns + column;
      if (cells_.z[i] == 0 || std::abs(cells_.z[i] - z) > kOneSurface * z) continue;
      const float weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row)) + kLeastShare;
      for (int t = 0; t < BouncedLight::terms; ++t) result.bounced[t] += weight * light_.term(t)[i];
      if (!albedo_.empty()) result.albedo += weight * albedo_[i];
      weights += weight;
    }
    result.known = weights > 0;
    if (!result.known) return result;
    for (float& each : result.bounced) each /= weights;
    result.albedo /= weights;
    return result;
  }

  // Cosine to the emitter by a plane through nine pixels of the surface: linear in inverse depth.
  double cosine(int u, int v, double x, double y, double z) const {
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    const auto& own = optics_.rays.at<cv::Vec2d>(v, u);
    for (int k = 0; k < 9; ++k) {
      const int c = u + step_px_ * (k % 3 - 1), r = v + step_px_ * (k / 3 - 1);
      if (k == 4 || c < 0 || r < 0 || c >= depth_mm_.cols || r >= depth_mm_.rows || !depth_mm_.at<std::uint16_t>(r, c))
        continue;
      const double other = depth_m(c, r);
      if (other <= 0 || std::abs(other - z) > kOneSlope * z) continue;
      const auto& ray = optics_.rays.at<cv::Vec2d>(r, c);
      const Eigen::Vector2d step(ray[0] - own[0], ray[1] - own[1]);
      matrix += step * step.transpose();
      right += (1 / other - 1 / z) * step;
    }
    if (matrix.determinant() <= kLeastSpread * matrix(0, 0) * matrix(1, 1)) return 1;
    const Eigen::Vector2d slope = matrix.inverse() * right;
    const Eigen::Vector3d plane(slope.x(), slope.y(), 1 / z - slope.x() * own[0] - slope.y() * own[1]);
    return lit_cosine(x, y, z, -plane.normalized());
  }

  double direct(int u, int v, double x, double y, double z, const Surroundings& about) const {
    const double lit = std::clamp(cosine(u, v, x, y, z), kLeastLitCosine, 1.0), geometric = direct_light(x, y, z, lit);
    if (pixels_.ir.empty() || about.albedo <= 0) return geometric;
    const auto counts = pixels_.ir.at<std::uint16_t>(v, u);
    if (counts == 0 || counts == kSaturated) return geometric;
    const double bounced = (about.bounced[0] + about.bounced[2] + about.bounced[4]) / 3, expected = geometric + bounced;
    if (expected <= 0) return geometric;
    const double measured = counts / 16.0 * light_per_count(x, y, z, pixels_.signal_counts) / about.albedo;
    // A pixel that is darker or brighter than expected has another slope or another albedo: by their variances.
    const double slope_sigma = kNormalSigma * std::sqrt(1 - lit * lit) / lit;
    const double part = slope_sigma * slope_sigma / (slope_sigma * slope_sigma + kAlbedoSigma * kAlbedoSigma);
    const double facing = direct_light(x, y, z, 1);
    return std::clamp(expected * std::pow(measured / expected, part) - bounced, kDarkest * facing, facing);
  }

  const cv::Mat& depth_mm_;
  const SurfaceCells& cells_;
  const BouncedLight& light_;
  const PixelLight& pixels_;
  const DepthOptics& optics_;
  int step_px_;
  std::vector<float> albedo_;  // by cell
};

}  // namespace

cv::Mat without_bounce(const cv::Mat& depth_mm, const SurfaceCells& cells, const BouncedLight& light,
                       const PixelLight& pixels, const DepthOptics& optics, double factor) {
  cv::Mat result = depth_mm.clone();
  const Pixels each(depth_mm, cells, light, pixels, optics);
  for (int v = 0; v < result.rows; ++v)
    for (int u = 0; u < result.cols; ++u) {
      auto& d = result.at<std::uint16_t>(v, u);
      if (d != 0) d = static_cast<std::uint16_t>(std::max(1.0, std::round(d - 1e3 * factor * each.error_m(u, v))));
    }
  return result;
}

}  // namespace dressform
