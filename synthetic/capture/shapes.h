#pragma once
#include "scenes/mesh.h"

namespace dressform {

// Closed, outward.
Mesh box_mesh(const Vector3d& minimum, const Vector3d& maximum);
// From `from` to `to`, closed by caps.
Mesh cylinder_mesh(const Vector3d& from, const Vector3d& to, double radius_m, int sides = 32);
Mesh sphere_mesh(const Vector3d& centre, double radius_m, int rings = 24);

// A rectangle from `corner` along `u` and `v`, facing u x v, with steps of about `step_m`. Texture coordinates of a
// grid: `grid_uv`, u along `u`, v along `v`, 0 to 1.
Mesh grid_mesh(const Vector3d& corner, const Vector3d& u, const Vector3d& v, double step_m);
std::vector<std::array<Vector2f, 3>> grid_uv(const Mesh& grid, const Vector3d& corner, const Vector3d& u,
                                             const Vector3d& v);

}  // namespace dressform
