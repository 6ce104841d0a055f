#include "pipeline/open/place_votes.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>

namespace dressform {
namespace {

// What a view shows at a point of the model, nothing where it is hidden or outside its images.
std::optional<Label> label_seen(const DepthView& view, const cv::Mat& labels, const Vector3d& point,
                                double in_front_m) {
  const Vector3d p = view.sensor_from_model * point, c = view.sensor->color_from_ir * p;
  if (p.z() <= 0 || c.z() <= 0) return {};
  const Vector2d ir = view.sensor->ir.project(p), color = view.sensor->color->project(c);
  const auto inside = [](const Vector2d& pixel, const cv::Mat& image) {
    return pixel.allFinite() && pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= image.cols - 1 &&
           pixel.y() <= image.rows - 1;
  };
  if (!inside(ir, view.depth_mm) || !inside(color, labels)) return {};
  const float z_mm =
      view.depth_mm.at<float>(static_cast<int>(std::lround(ir.y())), static_cast<int>(std::lround(ir.x())));
  if (z_mm > 0 && z_mm / 1000.0 < p.z() - in_front_m) return {};
  if (z_mm > 0 && z_mm / 1000.0 > p.z() + in_front_m) return Label::none;  // looked through
  return static_cast<Label>(
      labels.at<uchar>(static_cast<int>(std::lround(color.y())), static_cast<int>(std::lround(color.x()))));
}

}  // namespace

PlaceVotes place_votes(const Mesh& closed, Label garment, bool tucked, const OpenScene& scene, double in_front_m,
                       double least_cosine) {
  const std::vector<Vector3d> normals = vertex_normals(closed);
  const std::size_t count = closed.vertices.size();
  PlaceVotes votes{std::vector<double>(count, 0), std::vector<double>(count, 0)};
  const Label other = garment == Label::top ? Label::bottom : Label::top;
  for (const DepthView& view : scene.views) {
    const auto found = scene.segmentation.labels.find(scene.session.sensors[static_cast<std::size_t>(view.index)]);
    if (found == scene.segmentation.labels.end() || found->second.empty() || !view.sensor->color) continue;
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
      const Vector3d to_eye = view.model_from_sensor.translation() - closed.vertices[v];
      if (normals[v].dot(to_eye.normalized()) < least_cosine) return;
      const auto label = label_seen(view, found->second, closed.vertices[v], in_front_m);
      if (!label || (tucked && *label == other)) return;
      ++(*label == garment ? votes.garment : votes.elsewhere)[v];
    });
  }
  return votes;
}

}  // namespace dressform
