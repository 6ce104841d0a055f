#include "pipeline/geometry/poisson.h"

#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TriangleMesh.h>

#include <stdexcept>

namespace dressform {

Mesh poisson_surface(const PointCloud& cloud, int depth, double scale) {
  if (cloud.points.empty()) return {};
  open3d::geometry::PointCloud input;
  input.points_ = cloud.points;
  input.normals_ = cloud.normals;
  const auto surface = std::get<0>(open3d::geometry::TriangleMesh::CreateFromPointCloudPoisson(
      input, static_cast<std::size_t>(depth), 0.0f, static_cast<float>(scale), false, 1));
  Mesh mesh;
  mesh.vertices = surface->vertices_;
  mesh.triangles = surface->triangles_;
  return mesh;
}

std::vector<Vector3d> pca_normals(const std::vector<Vector3d>& points, int neighbours,
                                  const std::vector<Vector3d>& towards) {
  if (towards.size() != points.size()) throw std::invalid_argument("pca_normals: one direction is needed per point");
  if (points.empty()) return {};
  open3d::geometry::PointCloud cloud;
  cloud.points_ = points;
  cloud.EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(neighbours));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (cloud.normals_[i].dot(towards[i]) < 0) cloud.normals_[i] = -cloud.normals_[i];
  return cloud.normals_;
}

}  // namespace dressform
