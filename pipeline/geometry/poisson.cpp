#include "pipeline/geometry/poisson.h"

#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TriangleMesh.h>

namespace dressform {

Mesh poisson_surface(const PointCloud& cloud, int depth) {
  if (cloud.points.empty()) return {};
  open3d::geometry::PointCloud input;
  input.points_ = cloud.points;
  input.normals_ = cloud.normals;
  const auto surface = std::get<0>(open3d::geometry::TriangleMesh::CreateFromPointCloudPoisson(
      input, static_cast<std::size_t>(depth), 0.0f, 1.1f, false, 1));
  Mesh mesh;
  mesh.vertices = surface->vertices_;
  mesh.triangles = surface->triangles_;
  return mesh;
}

}  // namespace dressform
