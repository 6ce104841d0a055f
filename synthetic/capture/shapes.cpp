#include "synthetic/capture/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dressform {

Mesh box_mesh(const Vector3d& minimum, const Vector3d& maximum) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? maximum.x() : minimum.x(), i & 2 ? maximum.y() : minimum.y(),
                               i & 4 ? maximum.z() : minimum.z());
  const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : faces) {
    mesh.triangles.emplace_back(f[0], f[1], f[2]);
    mesh.triangles.emplace_back(f[0], f[2], f[3]);
  }
  return mesh;
}

Mesh cylinder_mesh(const Vector3d& from, const Vector3d& to, double radius_m, int sides) {
  Mesh mesh;
  const Vector3d axis = (to - from).normalized();
  const Vector3d side = (std::abs(axis.y()) < 0.9 ? Vector3d::UnitY() : Vector3d::UnitX()).cross(axis).normalized();
  const Vector3d other = axis.cross(side);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    const Vector3d out = radius_m * (std::cos(angle) * side + std::sin(angle) * other);
    mesh.vertices.push_back(from + out);
    mesh.vertices.push_back(to + out);
  }
  mesh.vertices.push_back(from);
  mesh.vertices.push_back(to);
  for (int i = 0; i < sides; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.emplace_back(a, b, a + 1);
    mesh.triangles.emplace_back(b, b + 1, a + 1);
    mesh.triangles.emplace_back(2 * sides, b, a);
    mesh.triangles.emplace_back(2 * sides + 1, a + 1, b + 1);
  }
  return mesh;
}

Mesh sphere_mesh(const Vector3d& centre, double radius_m, int rings) {
  Mesh mesh;
  const int sides = 2 * rings;
  mesh.vertices.push_back(centre + Vector3d(0, radius_m, 0));
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const double polar = M_PI * r / rings, angle = 2 * M_PI * s / sides;
      mesh.vertices.push_back(centre + radius_m * Vector3d(std::sin(polar) * std::cos(angle), std::cos(polar),
                                                           std::sin(polar) * std::sin(angle)));
    }
  mesh.vertices.push_back(centre - Vector3d(0, radius_m, 0));
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  for (int s = 0; s < sides; ++s) {
    const int next = (s + 1) % sides;
    mesh.triangles.emplace_back(0, 1 + next, 1 + s);
    for (int r = 0; r + 2 < rings; ++r) {
      const int a = 1 + r * sides;
      mesh.triangles.emplace_back(a + s, a + next, a + sides + s);
      mesh.triangles.emplace_back(a + next, a + sides + next, a + sides + s);
    }
    const int a = 1 + (rings - 2) * sides;
    mesh.triangles.emplace_back(a + s, a + next, last);
  }
  return mesh;
}

Mesh grid_mesh(const Vector3d& corner, const Vector3d& u, const Vector3d& v, double step_m) {
  const int columns = std::max(1, static_cast<int>(std::ceil(u.norm() / step_m)));
  const int rows = std::max(1, static_cast<int>(std::ceil(v.norm() / step_m)));
  Mesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) mesh.vertices.push_back(corner + u * c / columns + v * r / rows);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int a = r * (columns + 1) + c, b = a + columns + 1;
      mesh.triangles.emplace_back(a, a + 1, b + 1);
      mesh.triangles.emplace_back(a, b + 1, b);
    }
  return mesh;
}

std::vector<std::array<Vector2f, 3>> grid_uv(const Mesh& grid, const Vector3d& corner, const Vector3d& u,
                                             const Vector3d& v) {
  std::vector<std::array<Vector2f, 3>> result;
  for (const auto& triangle : grid.triangles) {
    std::array<Vector2f, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vector3d offset = grid.vertices[triangle[k]] - corner;
      corners[k] = Eigen::Vector2d(offset.dot(u) / u.squaredNorm(), offset.dot(v) / v.squaredNorm()).cast<float>();
    }
    result.push_back(corners);
  }
  return result;
}

}  // namespace dressform
