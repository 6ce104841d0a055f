#include "synthetic/body/body_tracking.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/random.h"

namespace dressform {
namespace {

constexpr std::uint8_t no_body = 255;

// Smooth noise: signed distance by which the outline wanders, pixels.
cv::Mat outline_sway(cv::Size size, double amplitude_px, Seed seed) {
  const double cell_px = std::max(2.0, size.width / 80.0);
  cv::Mat coarse(static_cast<int>(size.height / cell_px) + 3, static_cast<int>(size.width / cell_px) + 3, CV_32FC1);
  for (int y = 0; y < coarse.rows; ++y)
    for (int x = 0; x < coarse.cols; ++x)
      coarse.at<float>(y, x) = static_cast<float>(
          amplitude_px * normal(seed, stream_of("outline"), static_cast<std::uint64_t>(y) * 4096 + x));
  cv::Mat fine;
  cv::resize(coarse, fine, size, 0, 0, cv::INTER_CUBIC);
  return fine;
}

cv::Mat true_silhouette(const IrView& view) {
  cv::Mat inside(view.height(), view.width(), CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < view.height(); ++y)
    for (int left = 0; left < view.width(); left += packet_size) {
      const int count = std::min(packet_size, view.width() - left);
      Vector2f pixels[packet_size];
      Label labels[packet_size];
      for (int i = 0; i < count; ++i) pixels[i] = Vector2f(left + i, y);
      view.trace_labels(pixels, count, labels);
      for (int i = 0; i < count; ++i) inside.at<std::uint8_t>(y, left + i) = labels[i] == Label::none ? 0 : 255;
    }
  return inside;
}

}  // namespace

cv::Mat track_body_index(const IrView& view, Seed seed) {
  const cv::Mat inside = true_silhouette(view);
  cv::Mat depth_inside, depth_outside;
  cv::distanceTransform(inside, depth_inside, cv::DIST_L2, cv::DIST_MASK_5);
  cv::distanceTransform(255 - inside, depth_outside, cv::DIST_L2, cv::DIST_MASK_5);
  const cv::Mat sway = outline_sway(inside.size(), 1.2 * view.width() / 512.0, seed);
  const auto slot = static_cast<std::uint8_t>(6 * uniform(seed, stream_of("body_slot"), 0));
  cv::Mat index(inside.size(), CV_8UC1, cv::Scalar(no_body));
  for (int y = 0; y < index.rows; ++y)
    for (int x = 0; x < index.cols; ++x) {
      const float inward_px = depth_inside.at<float>(y, x) - depth_outside.at<float>(y, x);
      const auto speckle = normal(seed, stream_of("speckle"), static_cast<std::uint64_t>(y) * index.cols + x);
      if (inward_px + sway.at<float>(y, x) + 0.4f * static_cast<float>(speckle) > 0)
        index.at<std::uint8_t>(y, x) = slot;
    }
  return index;
}

Skeleton track_skeleton(const Body& body, const IrView& view, Seed seed) {
  constexpr double sigma_m = 0.010;
  const Isometry3d sensor_from_world = view.world_from_sensor().inverse();
  Skeleton skeleton;
  std::uint64_t number = 0;
  for (const auto& [name, position] : body.joints) {
    const auto noise = normal4(seed, stream_of("joints"), number++);
    Joint joint;
    joint.position = sensor_from_world * position + sigma_m * Vector3d(noise[0], noise[1], noise[2]);
    joint.tracked = joint.position.z() > 0.5 && view.camera().contains(view.camera().project(joint.position));
    skeleton[name] = joint;
  }
  return skeleton;
}

}  // namespace dressform
