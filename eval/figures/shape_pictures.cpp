#include "eval/figures/shape_pictures.h"

#include <cmath>

#include "eval/figures/run_views.h"
#include "eval/report/rim_marks.h"
#include "eval/report/stage_images.h"
#include "eval/report/turned.h"
#include "eval/run/rough_colors.h"

namespace dressform {
namespace {

const Eigen::Vector3f kClothColor(0.55f, 0.66f, 0.82f), kBoundaryColor(0.0f, 0.62f, 0.45f);
constexpr double kReach_m = 0.015, kTube_m = 0.004;

template <class Garments>
const auto* garment_of(const Garments& garments, const std::string& slot) {
  const auto found = garments.find(slot);
  return found == garments.end() ? nullptr : &found->second;
}

RenderItem plain_item(const Mesh& mesh, const Eigen::Vector3f& color) {
  RenderItem item;
  item.mesh = &mesh;
  item.color = color;
  return item;
}

PointCloud turned_cloud(PointCloud cloud, double heading) {
  for (auto& point : cloud.points) point = turned(point, heading);
  cloud.normals.clear();
  return cloud;
}

}  // namespace

cv::Mat one_view(Renderer& renderer, const std::vector<RenderItem>& items, double azimuth_deg) {
  Eigen::AlignedBox3d box;
  for (const auto& item : items) {
    const auto& points = item.points     ? item.points->points
                         : item.textured ? item.textured->mesh.vertices
                                         : item.mesh->vertices;
    for (const auto& point : points) box.extend(point);
  }
  if (box.isEmpty()) return {};
  const Vector3d size = box.sizes();
  const double part = std::clamp(std::hypot(size.x(), size.z()) / std::max(1e-6, size.y()), 0.4, 1.6);
  return renderer.render(
      look_at_box(box.min(), box.max(), azimuth_deg, 0, static_cast<int>(part * kFigureHeightPx), kFigureHeightPx),
      items);
}

cv::Mat closed_picture(const FigureInput& input, const std::string& slot, double azimuth_deg) {
  const auto* garment = garment_of(input.made.closed.get().garments, slot);
  if (!garment) return {};
  const Mesh mesh = turned(garment->mesh, front_heading(input.made));
  return one_view(input.renderer, {plain_item(mesh, kClothColor)}, azimuth_deg);
}

cv::Mat opened_picture(const FigureInput& input, const std::string& slot, double azimuth_deg, bool boundaries) {
  const auto* garment = garment_of(input.made.opened.get().garments, slot);
  if (!garment) return {};
  const double heading = front_heading(input.made);
  const Mesh mesh = turned(garment->mesh, heading);
  std::vector<Mesh> tubes;
  if (boundaries)
    for (const auto& loop : boundary_loops(mesh)) {
      std::vector<Vector3d> points;
      for (const int vertex : loop) points.push_back(mesh.vertices[vertex]);
      tubes.push_back(tube_along(points, kTube_m));
    }
  std::vector<RenderItem> items{plain_item(mesh, kClothColor)};
  for (const auto& tube : tubes)
    if (!tube.triangles.empty()) items.push_back(plain_item(tube, kBoundaryColor));
  return one_view(input.renderer, items, azimuth_deg);
}

cv::Mat textured_picture(const FigureInput& input, const std::string& slot, double azimuth_deg) {
  const auto* garment = garment_of(input.made.textured.get().garments, slot);
  if (!garment) return {};
  const TexturedMesh mesh = turned(*garment, front_heading(input.made));
  RenderItem item;
  item.textured = &mesh;
  item.shading = Shading::textured;
  return one_view(input.renderer, {item}, azimuth_deg);
}

cv::Mat cloud_picture(const FigureInput& input, const PointCloud& cloud, double azimuth_deg) {
  if (cloud.points.empty()) return {};
  const PointCloud points = turned_cloud(cloud, front_heading(input.made));
  RenderItem item;
  item.points = &points;
  item.shading = Shading::points;
  return one_view(input.renderer, {item}, azimuth_deg);
}

cv::Mat rough_picture(const FigureInput& input, const std::string& slot, double azimuth_deg) {
  const auto* garment = garment_of(input.made.closed.get().garments, slot);
  if (!garment) return {};
  PointCloud cloud;
  cloud.points = garment->mesh.vertices;
  cloud.colors = rough_colors(garment->mesh, garment->support, kReach_m);
  return cloud_picture(input, cloud, azimuth_deg);
}

cv::Mat support_picture(const FigureInput& input, const std::string& slot, double azimuth_deg) {
  const auto* garment = garment_of(input.made.closed.get().garments, slot);
  return garment ? cloud_picture(input, garment->support, azimuth_deg) : cv::Mat();
}

cv::Mat body_picture(const FigureInput& input, const Mesh& body, double heading_rad, double azimuth_deg) {
  const Mesh mesh = turned(body, heading_rad);
  return one_view(input.renderer, {plain_item(mesh, kBodyColor)}, azimuth_deg);
}

}  // namespace dressform
