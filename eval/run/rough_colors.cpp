#include "eval/run/rough_colors.h"

#include <nanoflann.hpp>

namespace dressform {
namespace {

struct Cloud {
  const std::vector<Vector3d>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;

const Vector3f kGrey = Vector3f::Constant(0.6f);

}  // namespace

std::vector<Vector3f> rough_colors(const Mesh& mesh, const PointCloud& cloud, double reach_m) {
  std::vector<Vector3f> colors(mesh.vertices.size(), kGrey);
  if (cloud.points.empty() || cloud.colors.size() != cloud.points.size()) return colors;
  const Cloud points{cloud.points};
  const Tree tree(3, points);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    std::uint32_t nearest = 0;
    double squared = 0;
    if (tree.knnSearch(mesh.vertices[i].data(), 1, &nearest, &squared) && squared <= reach_m * reach_m)
      colors[i] = cloud.colors[nearest];
  }
  return colors;
}

}  // namespace dressform
