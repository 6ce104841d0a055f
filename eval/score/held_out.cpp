#include "eval/score/held_out.h"

#include <opencv2/imgproc.hpp>

#include "eval/metrics/label_metrics.h"
#include "eval/metrics/sampling.h"

namespace dressform {
using namespace metrics;

namespace {

constexpr double kDistance_m = 2.10, kFocal_px = 1081.37;  // the set-up's distance; the SDK's focal length
constexpr int kMargin_px = 16;                             // round the true garment: more than half an SSIM window
struct Place {
  double azimuth_deg, elevation_deg;
};
constexpr Place kPlaces[] = {{45, 10}, {135, 20}, {225, 10}, {315, 20}};

// The view from a place towards the wearer's centre, cut out round the garment.
RenderView held_out_view(const Place& place, const Vector3d& centre, const Mesh& garment) {
  const double azimuth = place.azimuth_deg * M_PI / 180, elevation = place.elevation_deg * M_PI / 180;
  const Vector3d back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                      std::cos(azimuth) * std::cos(elevation));
  const Vector3d right(std::cos(azimuth), 0, -std::sin(azimuth));
  RenderView view;
  view.camera_from_world.linear() << right.transpose(), -back.cross(right).transpose(), -back.transpose();
  view.camera_from_world.translation() = -view.camera_from_world.linear() * (centre + kDistance_m * back);
  Eigen::AlignedBox2d box;
  for (const Vector3d& vertex : garment.vertices) {
    const Vector3d p = view.camera_from_world * vertex;
    if (p.z() > kDistance_m / 4) box.extend(Vector2d(kFocal_px * p.head<2>() / p.z()));
  }
  if (box.isEmpty()) box.extend(Vector2d::Zero());
  const Eigen::Vector2i low = box.min().array().floor().cast<int>() - kMargin_px,
                        size = box.max().array().ceil().cast<int>() + kMargin_px - low.array() + 1;
  view.camera.width = std::min(size.x(), 4096);
  view.camera.height = std::min(size.y(), 4096);
  view.camera.fx = view.camera.fy = kFocal_px;
  view.camera.cx = -low.x();
  view.camera.cy = -low.y();
  return view;
}

// The mesh in white where the triangles are marked and black elsewhere.
TexturedMesh marked(const TexturedMesh& mesh, const std::vector<bool>& marks) {
  TexturedMesh result;
  result.mesh = mesh.mesh;
  result.texture = cv::Mat(8, 16, CV_8UC3, cv::Scalar::all(0));
  result.texture.colRange(8, 16).setTo(cv::Scalar::all(255));
  for (std::size_t i = 0; i < mesh.mesh.triangles.size(); ++i) {
    const Vector2f at(marks[i] ? 0.75f : 0.25f, 0.5f);
    result.corner_uv.push_back({at, at, at});
  }
  return result;
}

// Pixels whose nearest pixel of the true garment was seen by no sensor: an estimate that reaches beyond the truth there
// is neither right nor wrong, as with surfaces.
cv::Mat nearest_unobserved(const cv::Mat& truth_mask, const cv::Mat& unobserved) {
  if (cv::countNonZero(unobserved) == 0 || cv::countNonZero(truth_mask == 0) == 0) return unobserved.clone();
  cv::Mat distance, labels;
  cv::distanceTransform(truth_mask == 0, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<uchar> of_label(1, 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      if (!truth_mask.at<uchar>(y, x)) continue;
      const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
      if (of_label.size() <= label) of_label.resize(label + 1, 0);
      of_label[label] = unobserved.at<uchar>(y, x);
    }
  cv::Mat result(labels.size(), CV_8U);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) result.at<uchar>(y, x) = of_label[labels.at<int>(y, x)];
  return result;
}

}  // namespace

HeldOutViews held_out_views(Renderer& renderer, const TexturedMesh& estimate, const TexturedMesh& truth,
                            const Vector3d& centre, const std::vector<bool>& unobserved) {
  RenderItem of_estimate, of_truth;
  of_estimate.textured = &estimate;
  of_truth.textured = &truth;
  of_estimate.shading = of_truth.shading = Shading::unlit;
  RenderOptions options;
  options.background.setConstant(0.5f);
  const TexturedMesh marks = unobserved.empty() ? TexturedMesh{} : marked(truth, unobserved);
  RenderItem of_marks;
  of_marks.textured = &marks;
  of_marks.shading = Shading::unlit;
  RenderOptions one_sample = options;  // as masks are drawn: no mixture of seen and unseen along outlines
  one_sample.samples = 1;
  HeldOutViews views;
  for (const auto& place : kPlaces) {
    const RenderView view = held_out_view(place, centre, truth.mesh);
    views.estimates.push_back(renderer.render(view, {of_estimate}, options));
    views.truths.push_back(renderer.render(view, {of_truth}, options));
    views.estimate_masks.push_back(renderer.mask(view, {of_estimate}));
    views.truth_masks.push_back(renderer.mask(view, {of_truth}));
    cv::Mat hidden(views.truth_masks.back().size(), CV_8U, cv::Scalar(0));
    if (!unobserved.empty()) {
      cv::extractChannel(renderer.render(view, {of_marks}, one_sample), hidden, 0);
      hidden = (hidden > 192) & views.truth_masks.back();
    }
    views.unobserved_masks.push_back(hidden);
  }
  return views;
}

HeldOutScores compare_views(const HeldOutViews& views) {
  HeldOutScores scores;
  const auto count = static_cast<double>(views.truths.size());
  std::vector<cv::Mat> both;
  for (std::size_t i = 0; i < views.truths.size(); ++i) both.push_back(views.estimate_masks[i] & views.truth_masks[i]);
  scores.gain = gain_to_match(views.estimates, views.truths, both);
  std::vector<double> differences;
  double squares = 0, values = 0, with_seen = 0;
  for (std::size_t i = 0; i < views.truths.size(); ++i) {
    const cv::Mat &truth = views.truths[i], either = views.estimate_masks[i] | views.truth_masks[i];
    cv::Mat adjusted = views.estimates[i].clone();
    with_gain(views.estimates[i], scores.gain).copyTo(adjusted, views.estimate_masks[i]);  // the background stays
    scores.ssim += masked_ssim(adjusted, truth, either) / count;
    const cv::Mat seen = either & ~nearest_unobserved(views.truth_masks[i], views.unobserved_masks[i]);
    if (cv::countNonZero(seen)) {
      scores.ssim_observed += masked_ssim(adjusted, truth, seen);
      ++with_seen;
    }
    scores.ssim_raw += masked_ssim(views.estimates[i], truth, either) / count;
    scores.silhouette_iou += label_iou(views.estimate_masks[i], views.truth_masks[i], 255) / count;
    const auto differ = color_differences(adjusted, truth, both[i]);
    differences.insert(differences.end(), differ.begin(), differ.end());
    squares += std::pow(cv::norm(adjusted, truth, cv::NORM_L2, both[i]), 2);
    values += 3.0 * cv::countNonZero(both[i]);
  }
  scores.ssim_observed /= with_seen;  // not a number where no view shows anything that was seen
  // 100 dB stands for equal images.
  scores.psnr_db = std::min(100.0, 10 * std::log10(255.0 * 255.0 * values / squares));
  scores.de2000_mean = mean(differences);
  scores.de2000_p95 = quantile(differences, 0.95);
  scores.pixels = static_cast<long>(differences.size());
  return scores;
}

}  // namespace dressform
