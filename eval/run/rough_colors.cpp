#include "eval/run/rough_colors.h"

#include "pipeline/geometry/point_tree.h"

namespace dressform {
namespace {

const Vector3f kGrey = Vector3f::Constant(0.6f);

}  // namespace

std::vector<Vector3f> rough_colors(const Mesh& mesh, const PointCloud& cloud, double reach_m) {
  std::vector<Vector3f> colors(mesh.vertices.size(), kGrey);
  if (cloud.points.empty() || cloud.colors.size() != cloud.points.size()) return colors;
  const PointTree tree(cloud.points);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    std::uint32_t nearest = 0;
    double squared = 0;
    if (tree.nearest(mesh.vertices[i], nearest, squared) && squared <= reach_m * reach_m)
      colors[i] = cloud.colors[nearest];
  }
  return colors;
}

}  // namespace dressform
