#include "pipeline/texture/color_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/edge_filter.hpp>

#include "pipeline/texture/noise.h"
#include "pipeline/texture/raster.h"

namespace dressform {
namespace {

constexpr float kFar = 1e6f;
constexpr double kNearest_m = 0.3;      // no camera stands nearer to a garment
constexpr double kUsual_m = 2;          // distance to a garment that has no vertex
constexpr double kInFront_m = 0.05;     // z from which a point is before the camera
constexpr double kSeen = 0.5;           // trust from which a pixel counts for the view's brightness
constexpr double kNothingHides_m = 10;  // no two surfaces of a capture are that far apart
constexpr double kChromaRange = 6;      // of luma, over its noise, within which chroma is shared

// Every triangle's z in the camera, nearest first, over the crop.
cv::Mat depth_of(const ColorView& view, const cv::Rect& crop, const std::vector<const Mesh*>& scenery) {
  cv::Mat depth(crop.size(), CV_32FC1, cv::Scalar(kFar));
  for (const Mesh* mesh : scenery) {
    std::vector<Vector2d> pixels(mesh->vertices.size(), Vector2d::Constant(std::nan("")));
    std::vector<double> z(mesh->vertices.size());
    tbb::parallel_for(std::size_t{0}, pixels.size(),
                      [&](std::size_t i) { view.project(mesh->vertices[i], pixels[i], z[i]); });
    for (const Vector3i& t : mesh->triangles)
      for_each_pixel(
          {pixels[t[0]], pixels[t[1]], pixels[t[2]]}, {{0, 0}, crop.size()}, [&](int x, int y, const Vector3d& w) {
            float& nearest = depth.at<float>(y, x);
            nearest = std::min(nearest, static_cast<float>(w[0] * z[t[0]] + w[1] * z[t[1]] + w[2] * z[t[2]]));
          });
  }
  return depth;
}

// No trust in pixels where something stands in front of the garment, whatever the mask says; where it was filled in, an
// arm is meant to be there.
void distrust_hidden(ColorView& view, const cv::Mat& garment_m, double gap_m) {
  for (int y = 0; y < view.trust.rows; ++y)
    for (int x = 0; x < view.trust.cols; ++x) {
      float& trust = view.trust.at<float>(y, x);
      const float z = garment_m.at<float>(y, x);
      if (trust > view.filled_trust && z < kFar && z > view.occluder_m.at<float>(y, x) + gap_m) trust = 0;
    }
}

cv::Mat disc(double radius_px) {
  const int size = 2 * static_cast<int>(std::lround(radius_px)) + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
}

// 0 outside the eroded mask, rising to 1 inside; what was filled in is trusted as far as asked.
cv::Mat trust_of(const cv::Mat& mask, double erode_px, double feather_px, float filled_trust) {
  cv::Mat padded, worn, seen, distance;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));  // what is cut off ends there
  seen = padded == 255;
  worn = filled_trust > 0 ? cv::Mat(padded > 0) : seen;  // else colours end where the arm begins
  cv::distanceTransform(worn, distance, cv::DIST_L2, cv::DIST_MASK_5);
  cv::Mat trust(mask.size(), CV_32FC1);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const double inside = distance.at<float>(y + 1, x + 1) - erode_px;
      const double rise = std::clamp(inside / std::max(feather_px, 1e-6), 0.0, 1.0);
      trust.at<float>(y, x) = static_cast<float>(rise) * (seen.at<uchar>(y + 1, x + 1) ? 1.f : filled_trust);
    }
  return trust;
}

// Blur that knows nothing of what is outside the mask; beyond it the colours continue smoothly.
cv::Mat blurred_within(const cv::Mat& color, const cv::Mat& trust, double sigma_px) {
  cv::Mat weight = cv::max(trust, 0.f), weights, weighted;
  cv::Mat blurred, sum;
  cv::merge(std::vector<cv::Mat>{weight, weight, weight}, weights);
  weighted = color.mul(weights);
  cv::GaussianBlur(weighted, blurred, {}, sigma_px, sigma_px, cv::BORDER_CONSTANT);
  cv::GaussianBlur(weights, sum, {}, sigma_px, sigma_px, cv::BORDER_CONSTANT);
  cv::Mat low;
  cv::divide(blurred, sum + cv::Scalar::all(1e-9), low);
  return low;
}

// Mean level of what is trusted.
double brightness(const cv::Mat& color, const cv::Mat& trust) {
  const cv::Scalar mean = cv::mean(color, trust > kSeen);
  return (mean[0] + mean[1] + mean[2]) / 3;
}

cv::Mat denoised(const cv::Mat& color, double range_levels) {
  if (!(range_levels > 0)) return color;
  constexpr double kReachPx = 1.5;
  cv::Mat smooth;
  cv::bilateralFilter(color, smooth, 5, range_levels, kReachPx);
  return smooth;
}

// Chroma smoothed where the luma is alike and the view is trusted: streams carry it at half the resolution, and one
// filter a pixel gives fine patterns colours that they do not have. The luma stays.
cv::Mat with_calm_chroma(const cv::Mat& color, const cv::Mat& trust, double reach_px, double range_levels) {
  if (!(reach_px > 0)) return color;
  const cv::Mat known = trust > 0;
  cv::Mat split, smooth, result;
  cv::cvtColor(color, split, cv::COLOR_BGR2YCrCb);
  std::vector<cv::Mat> parts;  // luma, and chroma with the weight of the trusted pixels
  cv::split(split, parts);
  const cv::Mat luma = parts[0].clone();
  known.convertTo(parts[0], CV_32F, 1 / 255.0);
  for (int c = 1; c < 3; ++c) cv::multiply(parts[c], parts[0], parts[c]);
  cv::Mat weighted;
  cv::merge(parts, weighted);
  cv::ximgproc::jointBilateralFilter(luma, weighted, smooth, 2 * static_cast<int>(std::ceil(2 * reach_px)) + 1,
                                     range_levels, reach_px);
  cv::split(smooth, parts);
  for (int c = 1; c < 3; ++c) cv::divide(parts[c], parts[0], parts[c]);
  parts[0] = luma;
  cv::merge(parts, smooth);
  cv::cvtColor(smooth, smooth, cv::COLOR_YCrCb2BGR);
  color.copyTo(result);
  smooth.copyTo(result, known);
  return result;
}

double garment_distance(const ColorView& view, const Mesh& garment) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : garment.vertices) box.extend(v);
  return box.isEmpty() ? kUsual_m : std::max(kNearest_m, (view.eye - box.center()).norm());
}

void fill_view(ColorView& view, const FilledGarment& filled, const Mesh& garment,
               const std::vector<const Mesh*>& scenery, const ViewParams& params) {
  const int margin = 8;
  cv::Rect crop = cv::boundingRect(filled.mask > 0);
  crop = cv::Rect(crop.x - margin, crop.y - margin, crop.width + 2 * margin, crop.height + 2 * margin) &
         cv::Rect({0, 0}, filled.mask.size());
  view.origin = Vector2d(crop.x, crop.y);
  filled.color(crop).convertTo(view.color, CV_32FC3);
  const double pixels_per_m = view.camera.fx / garment_distance(view, garment);
  view.filled_trust = static_cast<float>(params.filled_trust);
  view.trust = trust_of(filled.mask(crop), std::max(1.0, params.erode_m * pixels_per_m),
                        params.feather_m * pixels_per_m, view.filled_trust);
  const double noise = noise_levels(filled.color, brightness(view.color, view.trust));
  view.color = denoised(view.color, params.denoise * noise);
  view.color = with_calm_chroma(view.color, view.trust, params.chroma_px, kChromaRange * std::max(1.0, noise));
  cv::erode(depth_of(view, crop, scenery), view.occluder_m, disc(std::max(1.0, params.occluder_m * pixels_per_m)));
  distrust_hidden(view, depth_of(view, crop, {&garment}), params.occluder_gap_m);
  view.low = blurred_within(view.color, view.trust, std::max(1.0, params.band_m * pixels_per_m));
  view.low.copyTo(view.color, view.trust <= 0);  // so that no background comes in between pixels
}

}  // namespace

ViewParams as_photographed() {
  ViewParams view;
  view.denoise = 0;
  view.chroma_px = 0;
  return view;
}

ViewParams projected_blindly() {
  ViewParams view = as_photographed();
  view.filled_trust = 1;
  view.occluder_gap_m = kNothingHides_m;
  return view;
}

bool ColorView::project(const Vector3d& point, Vector2d& pixel, double& z_m) const {
  const Vector3d p = camera_from_model * point;
  z_m = p.z();
  if (!(z_m > kInFront_m)) return false;
  pixel = camera.project(p) - origin;
  return pixel.allFinite();
}

float ColorView::trust_at(const Vector2d& pixel, double z_m, double occluder_gap_m) const {
  const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
  if (x < 0 || y < 0 || x >= trust.cols || y >= trust.rows) return 0;
  const float here = linear1(trust, pixel);
  if (here <= filled_trust) return here;  // filled in: an arm is meant to be in front
  return z_m > occluder_m.at<float>(y, x) + occluder_gap_m ? 0.f : here;
}

std::vector<ColorView> color_views(const std::vector<std::string>& sensors, const Calibration& calibration,
                                   const Registration& registration, const std::map<std::string, FilledGarment>& filled,
                                   const Mesh& garment, const std::vector<const Mesh*>& scenery,
                                   const ViewParams& params) {
  std::vector<ColorView> views;
  for (const std::string& sensor : sensors) {
    const auto found = filled.find(sensor);
    const auto pose = registration.model_from_sensor.find(sensor);
    const auto calibrated = calibration.sensors.find(sensor);
    if (found == filled.end() || pose == registration.model_from_sensor.end() ||
        calibrated == calibration.sensors.end() || !calibrated->second.color || found->second.mask.empty() ||
        cv::countNonZero(found->second.mask) == 0)
      continue;
    ColorView view;
    view.sensor = sensor;
    view.camera = *calibrated->second.color;
    view.camera_from_model = calibrated->second.color_from_ir * pose->second.inverse();
    view.eye = view.camera_from_model.inverse().translation();
    fill_view(view, found->second, garment, scenery, params);
    views.push_back(std::move(view));
  }
  return views;
}

namespace {

template <class Value>
Value linear(const cv::Mat& image, const Vector2d& pixel) {
  const double x = std::clamp<double>(pixel.x(), 0, image.cols - 1),
               y = std::clamp<double>(pixel.y(), 0, image.rows - 1);
  const int x0 = std::min(static_cast<int>(x), image.cols - 1), y0 = std::min(static_cast<int>(y), image.rows - 1);
  const int x1 = std::min(x0 + 1, image.cols - 1), y1 = std::min(y0 + 1, image.rows - 1);
  const float fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const Value top = image.at<Value>(y0, x0) * (1 - fx) + image.at<Value>(y0, x1) * fx;
  const Value bottom = image.at<Value>(y1, x0) * (1 - fx) + image.at<Value>(y1, x1) * fx;
  return top * (1 - fy) + bottom * fy;
}

std::array<float, 4> catmull_rom(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {0.5f * (-t + 2 * t2 - t3), 0.5f * (2 - 5 * t2 + 3 * t3), 0.5f * (t + 4 * t2 - 3 * t3), 0.5f * (t3 - t2)};
}

}  // namespace

cv::Vec3f linear3(const cv::Mat& image, const Vector2d& pixel) { return linear<cv::Vec3f>(image, pixel); }
float linear1(const cv::Mat& image, const Vector2d& pixel) { return linear<float>(image, pixel); }

cv::Vec3f cubic3(const cv::Mat& image, const Vector2d& pixel) {
  const double x = std::clamp<double>(pixel.x(), 0, image.cols - 1),
               y = std::clamp<double>(pixel.y(), 0, image.rows - 1);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const auto wx = catmull_rom(static_cast<float>(x - x0)), wy = catmull_rom(static_cast<float>(y - y0));
  cv::Vec3f sum(0, 0, 0);
  for (int j = 0; j < 4; ++j) {
    const auto* row = image.ptr<cv::Vec3f>(std::clamp(y0 + j - 1, 0, image.rows - 1));
    cv::Vec3f line(0, 0, 0);
    for (int i = 0; i < 4; ++i) line += row[std::clamp(x0 + i - 1, 0, image.cols - 1)] * wx[i];
    sum += line * wy[j];
  }
  return sum;
}

}  // namespace dressform
