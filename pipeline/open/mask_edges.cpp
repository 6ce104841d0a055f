#include "pipeline/open/mask_edges.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kNearest_m = 0.1;  // of the depth camera: nearer is behind or beside it
constexpr double kJump_m = 0.05;    // between two places of one piece of cloth there is no larger step of depth

// One registered colour view.
struct ColorView {
  const DepthView* depth;
  const cv::Mat* labels;
  Vector3d centre;  // model frame
  Eigen::Matrix3d model_from_color;

  Vector3d ray(double x, double y) const {
    const Vector2d n = depth->sensor->color->normalized({x, y});
    return model_from_color * Vector3d(n.x(), n.y(), 1);
  }
};

struct Edge {
  double x, y;  // between two pixels
  int dx, dy;   // from the garment outwards
  Label beyond;
};

Label label_at(const cv::Mat& labels, int x, int y) { return static_cast<Label>(labels.at<uchar>(y, x)); }

// Edges between the garment and anything else that hold for some pixels on both sides.
std::vector<Edge> mask_edges(const cv::Mat& labels, Label garment, const MaskEdgeParams& params) {
  std::vector<Edge> edges;
  const int reach = std::max(params.inside_px, params.outside_px);
  constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (int y = reach; y < labels.rows - reach; ++y)
    for (int x = reach; x < labels.cols - reach; ++x) {
      if (label_at(labels, x, y) != garment) continue;
      for (const auto& step : kSteps) {
        if (label_at(labels, x + step[0], y + step[1]) == garment) continue;
        bool holds = true;
        for (int k = 1; k < params.inside_px; ++k)
          holds &= label_at(labels, x - k * step[0], y - k * step[1]) == garment;
        for (int k = 1; k <= params.outside_px; ++k)
          holds &= label_at(labels, x + k * step[0], y + k * step[1]) != garment;
        if (!holds) continue;
        edges.push_back(
            {x + step[0] * 0.5, y + step[1] * 0.5, step[0], step[1], label_at(labels, x + step[0], y + step[1])});
      }
    }
  return edges;
}

// Whether the depth camera measured something clearly nearer than the point.
bool hidden(const DepthView& view, const Vector3d& point, double in_front_m) {
  const Vector3d p = view.sensor_from_model * point;
  if (p.z() < kNearest_m) return true;
  const Vector2d pixel = view.sensor->ir.project(p);
  if (!pixel.allFinite() || !view.sensor->ir.contains(pixel)) return false;
  const float z =
      view.depth_mm.at<float>(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
  return z > 0 && z / 1000.0 < p.z() - in_front_m;
}

struct RimPoint {
  Vector3d point, beyond;  // on the closed surface at the edge, and a little outside it
  double cosine = 0;
};

// The point of the closed surface at an edge, if the edge is the end of the cloth.
std::optional<RimPoint> rim_point(const ColorView& view, const Edge& edge, const MeshQuery& closed,
                                  const MeshQuery& naked, const MaskEdgeParams& params) {
  const Vector3d ray = view.ray(edge.x, edge.y);
  const auto hit = closed.first_hit(view.centre, ray);
  if (!hit) return {};
  const double cosine = -closed.normal(hit->triangle).dot(ray) / ray.norm();
  if (cosine < params.least_cosine) return {};
  // The surface goes on beyond the edge (else it is an outline), and nothing lies before it on either side.
  const double step =
      std::max<double>(params.outside_px, params.goes_on_m * view.depth->sensor->color->fx / hit->distance);
  const Vector3d ray_beyond = view.ray(edge.x + step * edge.dx, edge.y + step * edge.dy);
  const auto further = closed.first_hit(view.centre, ray_beyond);
  if (!further || std::abs(further->distance - hit->distance) > kJump_m) return {};
  const auto body = naked.first_hit(view.centre, ray), body_beyond = naked.first_hit(view.centre, ray_beyond);
  if (body && body->distance < hit->distance - params.in_front_m) return {};
  if (body_beyond && body_beyond->distance < further->distance - params.in_front_m) return {};
  if (hidden(*view.depth, hit->point, 2 * params.in_front_m)) return {};
  return RimPoint{hit->point, further->point, cosine};
}

}  // namespace

std::map<std::string, std::vector<RimSample>> rim_samples(const Segmentation& segmentation, Label garment,
                                                          std::optional<Label> over, const CaptureSession& session,
                                                          const std::vector<DepthView>& views, const MeshQuery& closed,
                                                          const MeshQuery& naked, const Landmarks& limbs,
                                                          const std::vector<Opening>& openings,
                                                          const MaskEdgeParams& params) {
  std::map<std::string, std::vector<RimSample>> samples;
  for (const DepthView& view : views) {
    const auto labels = segmentation.labels.find(session.sensors[view.index]);
    if (labels == segmentation.labels.end() || labels->second.empty() || !view.sensor->color) continue;
    const Isometry3d model_from_color = view.model_from_sensor * view.sensor->color_from_ir.inverse();
    const ColorView color{&view, &labels->second, model_from_color.translation(), model_from_color.linear()};
    for (const Edge& edge : mask_edges(labels->second, garment, params)) {
      if (edge.beyond == over) continue;  // where they meet, it is the outer one that ends
      const auto point = rim_point(color, edge, closed, naked, params);
      if (!point) continue;
      const BodyPart part = limbs.part_of(naked.closest(point->point).triangle);
      const Opening* opening = opening_near(openings, point->point, part, limbs);
      if (!opening) continue;
      const double along = opening->along(point->point), rise = opening->along(point->beyond) - along;
      if (rise < params.least_rise * (point->beyond - point->point).norm()) continue;
      samples[opening->name].push_back({opening->angle(point->point), along, point->cosine, view.index});
    }
  }
  return samples;
}

}  // namespace dressform
