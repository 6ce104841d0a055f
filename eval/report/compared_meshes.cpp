#include "eval/report/compared_meshes.h"

#include <algorithm>
#include <cmath>

#include "eval/report/error_images.h"
#include "eval/report/image_tools.h"

namespace dressform {
namespace {

const Mesh& mesh_in(const RenderItem& item) { return item.textured ? item.textured->mesh : *item.mesh; }

double percentile_99(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

cv::Mat compared_meshes(Renderer& renderer, const RenderItem& first, const RenderItem& second,
                        const std::array<std::string, 2>& names, int height_px) {
  Eigen::AlignedBox3d box;
  for (const auto* item : {&first, &second})
    for (const auto& vertex : mesh_in(*item).vertices) box.extend(vertex);
  const double part = std::hypot(box.sizes().x(), box.sizes().z()) / std::max(1e-6, box.sizes().y());
  const int width = static_cast<int>(height_px * std::clamp(part, 0.4, 1.6));
  std::vector<RenderView> views;
  for (const double azimuth : {0.0, 90.0, 180.0, 270.0})
    views.push_back(look_at_box(box.min(), box.max(), azimuth, 0, width, height_px));
  const auto row = [&](const RenderItem& item) { return side_by_side(renderer.render(views, {item}), height_px); };
  RenderItem distance;
  distance.mesh = &mesh_in(first);
  distance.shading = Shading::scalar;
  distance.scalars = vertex_distances_mm(mesh_in(first), mesh_in(second));
  distance.scalar_maximum = std::max(1.0, percentile_99(distance.scalars));
  const cv::Mat apart = with_color_bar(row(distance), 0, distance.scalar_maximum, "mm", "distance");
  return stacked({titled(row(first), names[0]), titled(row(second), names[1]),
                  titled(apart, "distance of " + names[0] + " to " + names[1])});
}

}  // namespace dressform
