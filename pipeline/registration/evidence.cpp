#include "pipeline/registration/evidence.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr double kBehind_m = 0.05;  // more than noise, edges and a model's errors: what is seen there is another thing
constexpr int kParts = 6;           // of the body, two at each of three heights, left out in turn
constexpr int kPartPoints = 1500, kPartIterations = 6;

// Which part of the body a point (model frame) belongs to: thirds of the points by height, left and right.
std::vector<int> parts_of(const ViewPoints& view, const Isometry3d& model_from_sensor) {
  std::vector<double> heights, sides;
  const Vector3d right = model_from_sensor.linear().col(0);
  for (const int i : view.body) {
    const Vector3d p = model_from_sensor * view.map.points[i].cast<double>();
    heights.push_back(p.y());
    sides.push_back(right.dot(p));
  }
  const double low = lower_quantile(heights, 1.0 / 3), high = lower_quantile(heights, 2.0 / 3),
               middle = lower_quantile(sides, 0.5);
  std::vector<int> parts;
  for (std::size_t k = 0; k < heights.size(); ++k)
    parts.push_back(2 * (heights[k] < low ? 0 : heights[k] < high ? 1 : 2) + (sides[k] < middle ? 0 : 1));
  return parts;
}

// The view without one part of the body; points alone, the map is the view's own.
ViewPoints without_part(const ViewPoints& view, const std::vector<int>& parts, int left_out) {
  ViewPoints rest = view;
  rest.body.clear();
  for (std::size_t k = 0; k < view.body.size(); ++k)
    if (parts[k] != left_out) rest.body.push_back(view.body[k]);
  return rest;
}

// Delete-one-part jackknife of the pose (Efron, 1982): errors that neighbouring points share, a limb that moved or a
// model that is bent count, as they do not in the inverse of the normal equations.
void add_sigma(const ViewPoints& view, const ModelTarget& target, const ViewAlignment& alignment,
               PoseEvidence& evidence) {
  const auto parts = parts_of(view, alignment.model_from_sensor);
  std::array<Vector6d, kParts> twists;
  Vector3d centre = Vector3d::Zero();
  for (const int i : view.body) centre += alignment.model_from_sensor * view.map.points[i].cast<double>();
  centre /= static_cast<double>(view.body.size());
  bool all = true;
  for (int part = 0; part < kParts; ++part) {
    const ViewAlignment again = align_to_model(without_part(view, parts, part), target, alignment.model_from_sensor,
                                               {{0.015, 0.7, kPartPoints}}, kPartIterations);
    all = all && again.valid;
    twists[part] = motion_at(again.model_from_sensor * alignment.model_from_sensor.inverse(), centre);
  }
  Vector6d mean = Vector6d::Zero();
  for (const auto& twist : twists) mean += twist / kParts;
  Vector6d variance = Vector6d::Zero();
  for (const auto& twist : twists) variance += (kParts - 1.0) / kParts * (twist - mean).cwiseAbs2();
  const double none = std::numeric_limits<double>::infinity();
  evidence.rotation_sigma_deg = all ? kDegrees * std::sqrt(variance.head<3>().sum()) : none;
  evidence.translation_sigma_m = all ? std::sqrt(variance.tail<3>().sum()) : none;
}

void add_floor(const ViewPoints& view, const ModelTarget& target, const Isometry3d& model_from_sensor,
               PoseEvidence& evidence) {
  if (!target.has_floor() || !view.floor_plane) return;
  const Vector3d up = model_from_sensor.linear() * view.floor_plane->head<3>();
  // Height of the view's floor under the mannequin, at x = z = 0.
  const double offset = (*view.floor_plane)[3] - up.dot(model_from_sensor.translation());
  evidence.floor_tilt_deg = kDegrees * std::acos(std::clamp(up.y(), -1.0, 1.0));
  evidence.floor_height_m = -offset / std::max(up.y(), 0.1);
}

}  // namespace

double looked_through_part(const ViewPoints& view, const Isometry3d& model_from_view, const ViewPoints& other,
                           const Isometry3d& model_from_other, double margin_m) {
  const Projector projector(other.map.camera);
  const Isometry3d other_from_view = model_from_other.inverse() * model_from_view;
  const int width = other.map.camera.width, height = other.map.camera.height;
  int seen = 0, through = 0;
  for (const int i : view.body) {
    const Vector3f point = (other_from_view * view.map.points[i].cast<double>()).cast<float>();
    Vector2f pixel;
    if (!projector(point, pixel)) continue;
    const int u = static_cast<int>(pixel.x() + 0.5f), v = static_cast<int>(pixel.y() + 0.5f);
    float nearest = std::numeric_limits<float>::infinity();
    for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y)
      for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x) {
        const float z = other.map.points[static_cast<std::size_t>(y) * width + x].z();
        if (z > 0) nearest = std::min(nearest, z);
      }
    if (std::isinf(nearest)) continue;
    ++seen;
    through += nearest > point.z() + margin_m;
  }
  constexpr int kLeastShared = 50;
  return seen < kLeastShared ? 0 : static_cast<double>(through) / seen;
}

std::vector<PoseEvidence> gather_evidence(const std::vector<ViewPoints>& views, const ModelTarget& target,
                                          const std::vector<ViewAlignment>& alignments,
                                          const std::vector<char>& accepted) {
  std::vector<PoseEvidence> result(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!accepted[v]) return;
    PoseEvidence& evidence = result[v];
    const ViewAlignment& alignment = alignments[v];
    evidence.inlier_part = alignment.inlier_part;
    evidence.residual_over_noise = alignment.residual_rms_m / std::max(alignment.expected_rms_m, 1e-6);
    evidence.contradicted_part =
        contradicted_part(views[v], target, Projector(views[v].map.camera), alignment.model_from_sensor, kBehind_m);
    add_floor(views[v], target, alignment.model_from_sensor, evidence);
    for (std::size_t w = 0; w < views.size(); ++w)
      if (w != v && accepted[w])
        evidence.looked_through_part =
            std::max(evidence.looked_through_part, looked_through_part(views[v], alignment.model_from_sensor, views[w],
                                                                       alignments[w].model_from_sensor, kBehind_m));
    add_sigma(views[v], target, alignment, evidence);
  });
  return result;
}

std::string problem_with(const PoseEvidence& evidence, const AcceptanceOptions& options) {
  if (evidence.inlier_part < options.least_inlier_part)
    return fmt::format("{:.0f} % of its points lie on the model, of at least {:.0f} %", 100 * evidence.inlier_part,
                       100 * options.least_inlier_part);
  if (evidence.contradicted_part > options.largest_contradicted_part)
    return fmt::format("it looked through {:.0f} % of the model's surface", 100 * evidence.contradicted_part);
  if (evidence.looked_through_part > options.largest_looked_through_part)
    return fmt::format("another view looked through {:.0f} % of its points", 100 * evidence.looked_through_part);
  if (evidence.floor_tilt_deg > options.largest_floor_tilt_deg ||
      std::abs(evidence.floor_height_m) > options.largest_floor_height_m)
    return fmt::format("its floor is {:.1f} degrees and {:.0f} mm off the model's", evidence.floor_tilt_deg,
                       1000 * evidence.floor_height_m);
  if (evidence.residual_over_noise > options.largest_residual_over_noise)
    return fmt::format("its residual is {:.1f} times the noise", evidence.residual_over_noise);
  if (!(evidence.rotation_sigma_deg <= options.largest_rotation_sigma_deg &&
        evidence.translation_sigma_m <= options.largest_translation_sigma_m))
    return fmt::format("parts of the body put it {:.1f} degrees and {:.0f} mm apart", evidence.rotation_sigma_deg,
                       1000 * evidence.translation_sigma_m);
  return {};
}

}  // namespace dressform
