#pragma once
#include <memory>
#include <vector>

#include "scenes/mesh.h"

namespace dressform::metrics {

// What lies nearest to one point on a mesh.
struct NearestOnMesh {
  double distance_m = 0;
  int triangle = -1;                    // the lowest of several that are equally near
  int nearest_vertex = -1;              // corner of the triangle with the largest barycentric weight there
  Vector3d weights = Vector3d::Zero();  // barycentric
};

// Exact distances from points to the triangles of a mesh, and lines of sight past it (Embree). The candidates come from
// single precision boxes that are searched a little wider than needed; the distances are computed in double.
class MeshDistance {
 public:
  // Keeps a copy. Throws std::invalid_argument for a mesh without triangles.
  explicit MeshDistance(const Mesh& mesh);
  ~MeshDistance();
  MeshDistance(const MeshDistance&) = delete;
  MeshDistance& operator=(const MeshDistance&) = delete;

  const Mesh& mesh() const { return mesh_; }

  NearestOnMesh nearest(const Vector3d& point) const;
  // The same for many points, in their order, whatever the number of threads. Points are walked along a Morton curve,
  // so that each search starts from its predecessor's bound.
  std::vector<NearestOnMesh> nearest(const std::vector<Vector3d>& points) const;

  // Whether nothing of the mesh stands between `eye` and a point up to `slack_m` before it.
  bool sees(const Vector3d& eye, const Vector3d& point, double slack_m = 0.002) const;

 private:
  struct Device;
  NearestOnMesh search(const Vector3d& point, double bound_m) const;
  Mesh mesh_;
  std::unique_ptr<Device> device_;
};

// Geometric unit normal of a triangle; zero for one without area.
Vector3d triangle_normal(const Mesh& mesh, int triangle);

// Generalized winding number of a closed mesh round a point (Jacobson et al., SIGGRAPH 2013): 1 inside, 0 outside.
double winding_number(const Mesh& mesh, const Vector3d& point);

}  // namespace dressform::metrics
