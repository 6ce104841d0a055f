#include "pipeline/surface/garment_cloud.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "pipeline/geometry/point_tree.h"
#include "pipeline/imaging/color_mapping.h"
#include "pipeline/surface/depth_noise.h"

namespace dressform {
namespace {

constexpr double kEndSigma_px = 1.5;  // of the plane that pixels at the end of the cloth have to lie on
constexpr double kMadeUpWeight = 0.15;
constexpr double kAboveFloor_m = 0.03;   // lower points may be the floor
constexpr double kAtAnkles_m = 0.10;     // farthest off the legs that depth without colour counts as cloth
constexpr double kLargestShift_mm = 10;  // smoothing moves no depth further

// 255 at pixels beside a jump of the scene's depth, and at garment pixels with hardly any garment around them.
cv::Mat unreliable(const cv::Mat& garment_mm, const cv::Mat& scene_mm, double jump_mm) {
  cv::Mat result(garment_mm.size(), CV_8U, cv::Scalar(0));
  for (int y = 0; y < garment_mm.rows; ++y)
    for (int x = 0; x < garment_mm.cols; ++x) {
      const float z = garment_mm.at<float>(y, x);
      if (z <= 0) continue;
      int close = 0;
      bool jump = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int u = x + dx, v = y + dy;
          if ((!dx && !dy) || u < 0 || v < 0 || u >= garment_mm.cols || v >= garment_mm.rows) continue;
          const float other = garment_mm.at<float>(v, u), scene = scene_mm.at<float>(v, u);
          if (other > 0 && std::abs(other - z) < jump_mm) {
            ++close;
          } else if ((dx == 0 || dy == 0) && scene > 0 && std::abs(scene - z) > jump_mm) {
            jump = true;
          }
        }
      if (jump || close < 3) result.at<uchar>(y, x) = 255;
    }
  return result;
}

struct LocalPlane {
  bool found = false;
  Vector3d normal;  // towards the sensor
  double depth_mm = 0;
};

// Plane through the garment's points around a pixel, weighted by a Gaussian in the image; with or without its own
// point.
LocalPlane fit_plane(const cv::Mat& depth_mm, const cv::Mat& rays, int x, int y, double sigma_px, double jump_mm,
                     bool with_pixel = true) {
  LocalPlane plane;
  const double z0 = depth_mm.at<float>(y, x);
  Vector3d mean = Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double sum = 0;
  const double sigma = std::max(sigma_px, 1.0);
  const int reach = std::max(2, static_cast<int>(std::ceil(2 * sigma)));
  for (int v = std::max(0, y - reach); v <= std::min(depth_mm.rows - 1, y + reach); ++v)
    for (int u = std::max(0, x - reach); u <= std::min(depth_mm.cols - 1, x + reach); ++u) {
      const double z = depth_mm.at<float>(v, u);
      const int far = std::max(std::abs(u - x), std::abs(v - y));
      if (z <= 0 || std::abs(z - z0) > jump_mm * std::max(1, far) || (far == 0 && !with_pixel)) continue;
      const cv::Vec2f& ray = rays.at<cv::Vec2f>(v, u);
      const Vector3d p(ray[0] * z, ray[1] * z, z);
      const double w = std::exp(-0.5 * ((u - x) * (u - x) + (v - y) * (v - y)) / (sigma * sigma));
      sum += w;
      mean += w * p;
      spread += w * p * p.transpose();
    }
  if (sum < (with_pixel ? 3 : 1.5)) return plane;
  mean /= sum;
  spread = spread / sum - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  plane.normal = solver.eigenvectors().col(0);
  const cv::Vec2f& ray = rays.at<cv::Vec2f>(y, x);
  const Vector3d direction(ray[0], ray[1], 1);
  if (plane.normal.dot(direction) > 0) plane.normal = -plane.normal;
  const double slope = plane.normal.dot(direction);
  if (!plane.normal.allFinite() || std::abs(slope) < 1e-3) return plane;
  plane.depth_mm = sigma_px > 0 ? plane.normal.dot(mean) / slope : z0;
  plane.found = !with_pixel || std::abs(plane.depth_mm - z0) < kLargestShift_mm;
  return plane;
}

// The garment's depth without the pixels at the end of the cloth that have averaged it with what it lies on: a step of
// a finger's breadth is too small to show as a jump, but takes the pixel off the plane of the cloth around it.
cv::Mat without_mixed_ends(const cv::Mat& garment_mm, const DepthView& view, const GarmentCloudParams& params) {
  const cv::Mat elsewhere = (garment_mm <= 0) & (view.depth_mm > 0);
  cv::Mat beside;
  cv::dilate(elsewhere, beside, cv::Mat());
  cv::Mat inner = garment_mm.clone(), result = garment_mm.clone();
  inner.setTo(0, beside);
  for (int y = 0; y < inner.rows; ++y)
    for (int x = 0; x < inner.cols; ++x) {
      const float z = garment_mm.at<float>(y, x);
      if (z <= 0 || !beside.at<uchar>(y, x)) continue;
      inner.at<float>(y, x) = z;  // where the plane is wanted; it does not count
      const LocalPlane plane = fit_plane(inner, view.rays, x, y, kEndSigma_px, params.jump_mm, false);
      inner.at<float>(y, x) = 0;
      if (plane.found && std::abs(plane.depth_mm - z) > params.mixed_mm) result.at<float>(y, x) = 0;
    }
  return result;
}

// The garment's depth image with what joins it outside the colour camera's image and stands off the naked legs.
cv::Mat extended_depth(const cv::Mat& garment_mm, const DepthView& view, const MeshQuery& naked, const Landmarks& limbs,
                       const GarmentCloudParams& params) {
  cv::Mat result = garment_mm.clone();
  if (!view.sensor->color) return result;
  std::vector<cv::Point> front;
  for (int y = 0; y < result.rows; ++y)
    for (int x = 0; x < result.cols; ++x)
      if (result.at<float>(y, x) > 0) front.emplace_back(x, y);
  while (!front.empty()) {
    const cv::Point at = front.back();
    front.pop_back();
    for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point next = at + step;
      if (next.x < 0 || next.y < 0 || next.x >= result.cols || next.y >= result.rows || result.at<float>(next) > 0)
        continue;
      const float z = view.depth_mm.at<float>(next);
      if (z <= 0 || std::abs(z - result.at<float>(at)) > params.jump_mm) continue;
      const cv::Vec2f& ray = view.rays.at<cv::Vec2f>(next);
      const Vector3d seen = Vector3d(ray[0], ray[1], 1) * (z / 1000.0);
      const Vector3d in_color = view.sensor->color_from_ir * seen;
      if (in_color.z() > 0.1 && view.sensor->color->contains(view.sensor->color->project(in_color))) continue;
      const LocalPlane plane = fit_plane(view.depth_mm, view.rays, next.x, next.y, params.smooth_px, params.jump_mm);
      if (!plane.found) continue;
      const Vector3d point = view.model_from_sensor * (seen * (plane.depth_mm / z));
      if (point.y() < limbs.floor_y + kAboveFloor_m) continue;
      const auto closest = naked.closest(point, kAtAnkles_m);
      if (closest.triangle < 0 || !is_leg(limbs.triangle_parts[closest.triangle])) continue;
      if (naked.signed_distance(point, closest) < params.off_skin_m) continue;
      result.at<float>(next) = z;
      front.push_back(next);
    }
  }
  return result;
}

void add_view(FilledGarment garment, const DepthView& view, const GarmentCloudParams& params, GarmentCloud& result) {
  garment.depth_mm = without_mixed_ends(garment.depth_mm, view, params);
  const cv::Mat bad = unreliable(garment.depth_mm, view.depth_mm, params.jump_mm);
  const cv::Mat color_pixels = view.sensor->color ? color_of_depth_pixels(garment.depth_mm, *view.sensor) : cv::Mat();
  for (int y = 0; y < garment.depth_mm.rows; ++y)
    for (int x = 0; x < garment.depth_mm.cols; ++x) {
      const float z = garment.depth_mm.at<float>(y, x);
      if (!(z > 0)) continue;
      const LocalPlane plane = fit_plane(garment.depth_mm, view.rays, x, y, params.smooth_px, params.jump_mm);
      const cv::Vec2f& ray = view.rays.at<cv::Vec2f>(y, x);
      const Vector3d direction(ray[0], ray[1], 1);
      const double cosine = plane.found ? -plane.normal.dot(direction) / direction.norm() : 0;
      const bool made_up = !garment.synthetic.empty() && garment.synthetic.at<uchar>(y, x);
      if (cosine < params.least_cosine || (bad.at<uchar>(y, x) && !made_up)) {
        ++result.dropped;
        continue;
      }
      result.cloud.points.push_back(view.model_from_sensor * (direction * plane.depth_mm / 1000));
      result.cloud.normals.push_back(view.model_from_sensor.linear() * plane.normal);
      result.cloud.views.push_back(view.index);
      result.weights.push_back(static_cast<float>(cosine * cosine * (made_up ? kMadeUpWeight : 1)));
      Vector3f color(0.5f, 0.5f, 0.5f);
      if (!color_pixels.empty() && !garment.color.empty()) {
        const cv::Vec2f& at = color_pixels.at<cv::Vec2f>(y, x);
        if (std::isfinite(at[0])) {
          const int u = std::clamp(static_cast<int>(std::lround(at[0])), 0, garment.color.cols - 1);
          const int v = std::clamp(static_cast<int>(std::lround(at[1])), 0, garment.color.rows - 1);
          const cv::Vec3b& bgr = garment.color.at<cv::Vec3b>(v, u);
          color = Vector3f(bgr[2], bgr[1], bgr[0]) / 255.0f;
        }
      }
      result.cloud.colors.push_back(color);
    }
}

// Keeps the points for which keep[i] is set.
void filter(GarmentCloud& cloud, const std::vector<char>& keep) {
  GarmentCloud kept;
  kept.dropped = cloud.dropped;
  kept.noise_mm = cloud.noise_mm;
  kept.smoothing = cloud.smoothing;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) {
      ++kept.dropped;
      continue;
    }
    kept.cloud.points.push_back(cloud.cloud.points[i]);
    kept.cloud.normals.push_back(cloud.cloud.normals[i]);
    kept.cloud.colors.push_back(cloud.cloud.colors[i]);
    kept.cloud.views.push_back(cloud.cloud.views[i]);
    kept.weights.push_back(cloud.weights[i]);
  }
  cloud = std::move(kept);
}

std::vector<char> plausible(const GarmentCloud& cloud, const std::vector<DepthView>& views, const MeshQuery& naked,
                            double crotch_y, const GarmentCloudParams& params) {
  std::vector<char> keep(cloud.cloud.points.size(), 1);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const Vector3d& p = cloud.cloud.points[i];
    const double farthest = p.y() > crotch_y ? params.outside_body_m : params.outside_legs_m;
    const auto closest = naked.closest(p, std::max(farthest, params.inside_body_m) + 0.01);
    const double distance = naked.signed_distance(p, closest);
    keep[i] = distance >= -params.inside_body_m && distance <= farthest;
    for (const DepthView& view : views)
      if (keep[i] && view.index != cloud.cloud.views[i] && free_space_violation_m(view, p) > params.see_through_m)
        keep[i] = 0;
  }
  return keep;
}

std::vector<char> statistical_inliers(const std::vector<Vector3d>& points, int neighbours, double sigmas) {
  std::vector<char> keep(points.size(), 1);
  if (static_cast<int>(points.size()) <= neighbours) return keep;
  const PointTree tree(points);
  std::vector<double> mean(points.size());
  std::vector<double> squared;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t found = tree.nearest_squared(points[i], neighbours + 1, squared);
    for (std::size_t k = 0; k < found; ++k) mean[i] += std::sqrt(squared[k]) / neighbours;
    sum += mean[i];
    squares += mean[i] * mean[i];
  }
  const double average = sum / points.size();
  const double deviation = std::sqrt(std::max(0.0, squares / points.size() - average * average));
  for (std::size_t i = 0; i < points.size(); ++i) keep[i] = mean[i] <= average + sigmas * deviation;
  return keep;
}

// Averages over more leave less noise and more of the cloth's bends: the balance moves with the root of the noise.
double smoothing_for(double noise_mm, const GarmentCloudParams& params) {
  constexpr double kMost = 1.6;
  return std::clamp(std::sqrt(noise_mm / params.usual_noise_mm), 1.0, kMost);
}

}  // namespace

GarmentCloud garment_cloud(const std::string& garment, const FilledViews& filled, const std::vector<DepthView>& views,
                           const CaptureSession& session, const MeshQuery& naked, const Landmarks& limbs,
                           const GarmentCloudParams& params) {
  GarmentCloud result;
  const auto shots = filled.garments.find(garment);
  if (shots == filled.garments.end()) return result;
  std::vector<std::pair<const DepthView*, const FilledGarment*>> seen;
  std::vector<cv::Mat> depths;
  for (const DepthView& view : views) {
    const auto shot = shots->second.find(session.sensors[view.index]);
    if (shot == shots->second.end() || shot->second.depth_mm.size() != view.depth_mm.size()) continue;
    seen.emplace_back(&view, &shot->second);
    depths.push_back(shot->second.depth_mm);
  }
  result.noise_mm = depth_noise_mm(depths, params.jump_mm);
  result.smoothing = smoothing_for(result.noise_mm, params);
  GarmentCloudParams own = params;
  own.smooth_px *= result.smoothing;
  for (const auto& [view, shot] : seen) {
    FilledGarment each = *shot;
    if (garment == "bottom") each.depth_mm = extended_depth(each.depth_mm, *view, naked, limbs, own);
    add_view(each, *view, own, result);
  }
  filter(result, plausible(result, views, naked, limbs.crotch_y, params));
  filter(result, statistical_inliers(result.cloud.points, params.neighbours, params.outlier_sigma));
  return result;
}

}  // namespace dressform
