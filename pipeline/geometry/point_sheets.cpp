#include "pipeline/geometry/point_sheets.h"

#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TetraMesh.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/utility/Logging.h>

#include <algorithm>
#include <array>
#include <map>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr std::size_t kTetrahedron = 4;  // points below which there is nothing to make a surface of

// Open3D warns of every flat tetrahedron, of which a sheet of points has many.
class QuietOpen3d {
 public:
  QuietOpen3d() : before_(open3d::utility::GetVerbosityLevel()) {
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  }
  ~QuietOpen3d() { open3d::utility::SetVerbosityLevel(before_); }
  QuietOpen3d(const QuietOpen3d&) = delete;
  QuietOpen3d& operator=(const QuietOpen3d&) = delete;

 private:
  open3d::utility::VerbosityLevel before_;
};

open3d::geometry::PointCloud open3d_cloud(const PointCloud& cloud) {
  open3d::geometry::PointCloud result;
  result.points_ = cloud.points;
  result.normals_ = cloud.normals;
  return result;
}

Vector3d corners_normal(const Mesh& mesh, const Vector3i& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

// Vertices are points of the cloud: each triangle is turned towards the sum of its points' normals.
void turn_towards_normals(const PointCloud& cloud, Mesh& mesh) {
  std::map<std::array<double, 3>, std::size_t> number;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    number.emplace(std::array<double, 3>{cloud.points[i].x(), cloud.points[i].y(), cloud.points[i].z()}, i);
  for (Vector3i& t : mesh.triangles) {
    Vector3d towards = Vector3d::Zero();
    for (const int v : t) {
      const Vector3d& p = mesh.vertices[v];
      if (const auto found = number.find({p.x(), p.y(), p.z()}); found != number.end())
        towards += cloud.normals[found->second];
    }
    if (corners_normal(mesh, t).dot(towards) < 0) std::swap(t[1], t[2]);
  }
}

}  // namespace

double median_spacing_m(const std::vector<Vector3d>& points) {
  if (points.size() < 2) return 0;
  open3d::geometry::PointCloud cloud;
  cloud.points_ = points;
  return median(cloud.ComputeNearestNeighborDistance());
}

Mesh ball_pivoting_sheet(const PointCloud& cloud, const std::vector<double>& radii_m) {
  if (cloud.points.size() < kTetrahedron) return {};
  const QuietOpen3d quiet;
  const auto surface = open3d::geometry::TriangleMesh::CreateFromPointCloudBallPivoting(open3d_cloud(cloud), radii_m);
  Mesh mesh;
  mesh.vertices = surface->vertices_;
  mesh.triangles = surface->triangles_;
  return compacted(mesh);
}

Mesh alpha_shape_sheet(const PointCloud& cloud, double alpha_m) {
  if (cloud.points.size() < kTetrahedron) return {};
  const QuietOpen3d quiet;
  const auto surface = open3d::geometry::TriangleMesh::CreateFromPointCloudAlphaShape(open3d_cloud(cloud), alpha_m);
  Mesh mesh;
  mesh.vertices = surface->vertices_;
  mesh.triangles = surface->triangles_;
  turn_towards_normals(cloud, mesh);
  return compacted(mesh);
}

}  // namespace dressform
