#pragma once
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Closest points, signed distances and first hits on a triangle mesh (Embree). Safe to ask from several threads; the
// answers do not depend on their number.
class MeshQuery {
 public:
  struct Closest {
    int triangle = -1;  // -1: nothing within the asked distance
    Vector3d point = Vector3d::Zero();
    double distance = std::numeric_limits<double>::infinity();
  };
  struct Hit {
    int triangle = -1;
    double distance = 0;  // in units of the direction's length
    Vector3d point = Vector3d::Zero();
  };

  // Keeps its own copy of the mesh. A mesh without triangles answers "nothing" to everything.
  explicit MeshQuery(const Mesh& mesh);
  ~MeshQuery();
  MeshQuery(MeshQuery&&) noexcept;
  MeshQuery& operator=(MeshQuery&&) noexcept;

  const Mesh& mesh() const { return mesh_; }

  Closest closest(const Vector3d& point, double max_distance = std::numeric_limits<double>::infinity()) const;

  // Distance, negative inside a closed outward mesh: the sign by the angle-weighted pseudonormal (Baerentzen and
  // Aanaes, 2005). Positive infinity for an empty mesh.
  double signed_distance(const Vector3d& point) const;
  double signed_distance(const Vector3d& point, const Closest& closest) const;

  // The first triangle met from `origin` along `direction` (any length), at least `near` away.
  std::optional<Hit> first_hit(const Vector3d& origin, const Vector3d& direction, double near = 0) const;

  // Unit normal of a triangle; zero for one without area.
  const Vector3d& normal(int triangle) const { return face_normals_[triangle]; }

 private:
  struct Device;
  Vector3d pseudonormal(const Closest& closest) const;

  Mesh mesh_;
  std::vector<Vector3d> face_normals_, corner_normals_;
  std::vector<std::array<Vector3d, 3>> side_normals_;  // of the side opposite to corner k
  std::unique_ptr<Device> device_;
};

}  // namespace dressform
