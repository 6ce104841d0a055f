#pragma once
#include <memory>

#include "scenes/mesh.h"

namespace dressform {

// Closest points on a mesh (Embree point queries).
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const Mesh& mesh);
  ~SurfaceDistance();
  SurfaceDistance(const SurfaceDistance&) = delete;
  SurfaceDistance& operator=(const SurfaceDistance&) = delete;

  struct Closest {
    bool found = false;
    Vector3d point, normal;  // unit normal, interpolated between the vertices' normals
    double height = 0;       // of the query along that normal: positive outside, metres
    double distance = 0;
  };
  // The closest point no further than `reach_m`.
  Closest closest(const Vector3d& query, double reach_m) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

// Pushes vertices of cloth that lie nearer than `clearance_m` to the surface, or within 30 mm behind it, out along its
// normal, and smooths the push over the cloth. Triangles stay as they are.
Mesh pushed_clear(const Mesh& cloth, const Mesh& surface, double clearance_m);

}  // namespace dressform
