#include "pipeline/open/depth_edges.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "pipeline/imaging/color_mapping.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr float kUnknown = -1;       // of a pixel's cover
constexpr double kStill_mm = 8;      // most that bare skin's depth differs between the shots
constexpr std::size_t kFewest = 30;  // pixels of bare skin
constexpr double kFarGap_m = 0.04;   // what lies further behind the cloth is all the same

Vector3d ray_of(const DepthView& view, double x, double y) {
  const Vector2d n = view.sensor->ir.normalized({x, y});
  return view.model_from_sensor.linear() * Vector3d(n.x(), n.y(), 1);
}

// One view and what is known of it besides its depth.
struct SeenView {
  const DepthView& depth;
  cv::Mat labels;    // at the depth pixels; empty where the colour image has none
  cv::Mat naked_mm;  // the naked shot, true depth; empty if there is none from the same place

  Label label(int x, int y) const { return labels.empty() ? Label::none : static_cast<Label>(labels.at<uchar>(y, x)); }
};

// Whether bare skin has the same depth in both shots.
bool stood_still(const SeenView& view, const cv::Mat& naked_mm) {
  std::vector<float> shifts;
  for (int y = 0; y < naked_mm.rows; ++y)
    for (int x = 0; x < naked_mm.cols; ++x) {
      const float dressed = view.depth.depth_mm.at<float>(y, x), naked = naked_mm.at<float>(y, x);
      if (dressed <= 0 || naked <= 0 || view.label(x, y) != Label::skin) continue;
      shifts.push_back(std::abs(dressed - naked));
    }
  if (shifts.size() < kFewest) return false;
  return median(std::move(shifts)) < kStill_mm;
}

SeenView seen_view(const DepthView& depth, const CaptureSession& session, const Segmentation& segmentation) {
  const std::string& name = session.sensors[depth.index];
  SeenView view{depth, {}, {}};
  const auto labels = segmentation.labels.find(name);
  if (labels != segmentation.labels.end() && depth.sensor->color && !labels->second.empty())
    view.labels = to_depth(labels->second, color_of_depth_pixels(depth.depth_mm, *depth.sensor));
  const auto shot = session.naked.find(name);
  if (shot == session.naked.end() || shot->second.depth_mm.size() != depth.depth_mm.size()) return view;
  const cv::Mat naked_mm = corrected_depth_mm(shot->second.depth_mm, *depth.sensor);
  if (stood_still(view, naked_mm)) cv::medianBlur(naked_mm, view.naked_mm, 3);
  return view;
}

// How much of a pixel is cloth, 0-1: where its depth lies between the closed surface and the body behind it. kUnknown
// without depth, beside the closed surface, where both are as near, and where the other garment is.
cv::Mat cover(const SeenView& view, Label other, const MeshQuery& closed, const MeshQuery& naked,
              const DepthEdgeParams& params) {
  cv::Mat part(view.depth.depth_mm.size(), CV_32F, cv::Scalar(kUnknown));
  const Vector3d centre = view.depth.model_from_sensor.translation();
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x) {
      const double z = view.depth.depth_mm.at<float>(y, x) / 1000.0;
      if (!(z > 0) || view.label(x, y) == other) continue;
      const Vector3d ray = ray_of(view.depth, x, y);  // one metre deep
      const auto cloth = closed.first_hit(centre, ray);
      if (!cloth) continue;
      double behind = cloth->distance + kFarGap_m;
      if (const auto skin = naked.first_hit(centre, ray)) behind = std::min(behind, skin->distance);
      if (!view.naked_mm.empty() && view.naked_mm.at<float>(y, x) > 0)
        behind = std::min(cloth->distance + kFarGap_m, view.naked_mm.at<float>(y, x) / 1000.0);
      const double gap = behind - cloth->distance;
      if (gap < params.least_gap_m || z < cloth->distance - gap) continue;
      part.at<float>(y, x) = static_cast<float>(std::clamp(1 - (z - cloth->distance) / gap, 0.0, 1.0));
    }
  return part;
}

// Where cover falls below a half on the way from a pixel, in pixels; absent if it does not, or not clearly.
std::optional<double> crossing(const cv::Mat& part, int x, int y, int dx, int dy, const DepthEdgeParams& params) {
  const auto at = [&](int k) {
    const int u = x + k * dx, v = y + k * dy;
    return u < 0 || v < 0 || u >= part.cols || v >= part.rows ? kUnknown : part.at<float>(v, u);
  };
  for (int k = 0; k < params.inside_px; ++k)
    if (at(-k) < 0.5f) return {};
  int first = 1;
  while (first <= params.most_missing_px && at(first) == kUnknown) ++first;
  for (int k = first; k < first + params.outside_px; ++k)
    if (at(k) == kUnknown || at(k) >= 0.5f) return {};
  if (first > 1) return first / 2.0;
  return (at(0) - 0.5) / (at(0) - at(1));  // pixels at the end show as much of the cloth as their depth is its
}

// The rim point between two neighbouring depth pixels, if the garment ends there.
void add_sample(const DepthView& view, const Vector2d& inside, const Vector2d& edge, const MeshQuery& closed,
                const MeshQuery& naked, const Landmarks& limbs, const std::vector<Opening>& openings,
                const DepthEdgeParams& params, std::map<std::string, std::vector<RimSample>>& samples) {
  const Vector3d centre = view.model_from_sensor.translation(), ray = ray_of(view, edge.x(), edge.y());
  const auto hit = closed.first_hit(centre, ray);
  const auto from = closed.first_hit(centre, ray_of(view, inside.x(), inside.y()));
  if (!hit || !from) return;
  const double cosine = -closed.normal(hit->triangle).dot(ray) / ray.norm();
  if (cosine < params.least_cosine) return;
  const BodyPart below = limbs.part_of(naked.closest(hit->point).triangle);
  const Opening* opening = opening_near(openings, hit->point, below, limbs);
  if (!opening || opening->shape == Opening::Shape::polar) return;
  const double along = opening->along(hit->point);
  if (along - opening->along(from->point) < params.least_rise * (hit->point - from->point).norm()) return;
  samples[opening->name].push_back({opening->angle(hit->point), along, cosine, view.index});
}

}  // namespace

std::map<std::string, std::vector<RimSample>> depth_rim_samples(
    const Segmentation& segmentation, Label garment, const CaptureSession& session, const std::vector<DepthView>& views,
    const MeshQuery& closed, const MeshQuery& naked, const Landmarks& limbs, const std::vector<Opening>& openings,
    const DepthEdgeParams& params) {
  const Label other = garment == Label::top ? Label::bottom : Label::top;
  std::map<std::string, std::vector<RimSample>> samples;
  constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const DepthView& view : views) {
    const cv::Mat part = cover(seen_view(view, session, segmentation), other, closed, naked, params);
    for (int y = 0; y < part.rows; ++y)
      for (int x = 0; x < part.cols; ++x) {
        if (part.at<float>(y, x) < 0.5f) continue;
        for (const auto& step : kSteps) {
          const auto way = crossing(part, x, y, step[0], step[1], params);
          if (!way) continue;
          const Vector2d at(x, y), forth(step[0], step[1]);
          add_sample(view, at - forth, at + *way * forth, closed, naked, limbs, openings, params, samples);
        }
      }
  }
  return samples;
}

std::vector<RimSample> reconciled(const std::vector<RimSample>& mask_edges, const std::vector<RimSample>& depth_edges,
                                  double contradiction_m) {
  constexpr double kSameDirection = 0.1;  // radians
  std::vector<RimSample> result;
  for (const RimSample& mask : mask_edges) {
    bool judged = false, agreed = false;
    for (const RimSample& depth : depth_edges) {
      if (depth.view != mask.view || std::abs(std::remainder(depth.angle - mask.angle, 2 * M_PI)) > kSameDirection)
        continue;
      judged = true;
      agreed |= std::abs(depth.along - mask.along) <= contradiction_m;
    }
    if (!judged || agreed) result.push_back(mask);
  }
  result.insert(result.end(), depth_edges.begin(), depth_edges.end());
  return result;
}

}  // namespace dressform
