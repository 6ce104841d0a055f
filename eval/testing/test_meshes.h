#pragma once
#include <cmath>

#include "scenes/mesh.h"

namespace dressform::test_meshes {

// Square [0, size]^2 in the plane z = height, facing +z, of n x n cells.
inline Mesh square(double size, double height, int n) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.push_back({size * j / n, size * i / n, height});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

// Elliptic tube about the vertical through `center`, outward, from y = low to y = high; open, or closed by caps.
inline Mesh tube(double radius_x, double radius_z, const Vector3d& center, double low, double high, int sectors,
                 int rings, bool closed) {
  Mesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double turn = 2 * M_PI * j / sectors;
      mesh.vertices.push_back(
          center + Vector3d(radius_x * std::sin(turn), low + (high - low) * i / rings, radius_z * std::cos(turn)));
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int a = i * sectors + j, b = i * sectors + (j + 1) % sectors, c = a + sectors, d = b + sectors;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  if (!closed) return mesh;
  const int bottom = static_cast<int>(mesh.vertices.size()), top = bottom + 1, last = rings * sectors;
  mesh.vertices.push_back(center + Vector3d(0, low, 0));
  mesh.vertices.push_back(center + Vector3d(0, high, 0));
  for (int j = 0; j < sectors; ++j) {
    const int next = (j + 1) % sectors;
    mesh.triangles.push_back({bottom, next, j});
    mesh.triangles.push_back({top, last + j, last + next});
  }
  return mesh;
}

inline Mesh sphere(double radius, const Vector3d& center, int rings) {
  Mesh mesh;
  const int sectors = 2 * rings;
  mesh.vertices.push_back(center + Vector3d(0, radius, 0));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / sectors;
      mesh.vertices.push_back(center + radius * Vector3d(std::sin(polar) * std::sin(turn), std::cos(polar),
                                                         std::sin(polar) * std::cos(turn)));
    }
  mesh.vertices.push_back(center - Vector3d(0, radius, 0));
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int ring, int sector) { return 1 + (ring - 1) * sectors + sector % sectors; };
  for (int j = 0; j < sectors; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({south, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// The triangles of both.
inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const int offset = static_cast<int>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) mesh.triangles.push_back(t + Vector3i::Constant(offset));
  return mesh;
}

inline Mesh moved(Mesh mesh, const Vector3d& step) {
  for (auto& vertex : mesh.vertices) vertex += step;
  return mesh;
}

// A standing figure of tubes, 1.8 m tall: legs to 0.85, torso of changing ellipse to 1.5 (waist at 1.1), arms apart
// from it below 1.4 and inside one broad ellipse above.
inline Mesh figure(double girth_scale = 1) {
  const double s = girth_scale;
  Mesh mesh = joined(tube(0.08 * s, 0.08 * s, {0.1 * s, 0, 0}, 0, 0.85, 32, 20, true),
                     tube(0.08 * s, 0.08 * s, {-0.1 * s, 0, 0}, 0, 0.85, 32, 20, true));
  Mesh torso = tube(1, 1, {0, 0, 0}, 0.85, 1.4, 64, 55, true);
  for (auto& vertex : torso.vertices) {
    const double waist = 1 - 0.15 * std::exp(-std::pow((vertex.y() - 1.1) / 0.08, 2));
    vertex.x() *= 0.18 * s * waist;
    vertex.z() *= 0.12 * s * waist;
  }
  mesh = joined(mesh, torso);
  mesh = joined(mesh, tube(0.3 * s, 0.12 * s, {0, 0, 0}, 1.4, 1.5, 64, 10, true));
  for (const double side : {-1.0, 1.0})
    mesh = joined(mesh, tube(0.04 * s, 0.04 * s, {side * 0.26 * s, 0, 0}, 0.8, 1.4, 24, 20, true));
  return joined(mesh, tube(0.07, 0.09, {0, 0, 0}, 1.5, 1.8, 24, 10, true));
}

}  // namespace dressform::test_meshes
