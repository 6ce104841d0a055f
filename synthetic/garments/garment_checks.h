#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "synthetic/garments/drape/cloth.h"
#include "synthetic/garments/garment.h"
#include "synthetic/geometry/self_intersection.h"
#include "synthetic/geometry/surface_distance.h"

// What the tests of garments ask of all of them.
namespace dressform {

inline GarmentSpec garment(const std::string& kind, double sleeve_or_length, const std::string& print = "plain") {
  GarmentSpec spec;
  spec.kind = kind;
  spec.slot = kind == "shirt" ? "top" : "bottom";
  spec.sleeve = spec.length = sleeve_or_length;
  spec.ease_m = 0.08;
  spec.print.kind = print;
  spec.cloth_edge_m = 0.010;  // coarser than usual, for time
  return spec;
}

inline BodySpec sampled(const std::string& who, int seed) {
  BodySpec spec;
  spec.sample = who;
  spec.sample_seed = seed;
  return spec;
}

inline double lowest(const std::vector<Vector3d>& points) {
  double low = 9;
  for (const Vector3d& p : points) low = std::min(low, p.y());
  return low;
}

inline double highest(const std::vector<Vector3d>& points) {
  double high = -9;
  for (const Vector3d& p : points) high = std::max(high, p.y());
  return high;
}

inline void expect_well_cut(const Garment& garment, const std::vector<std::string>& names) {
  const Mesh& mesh = garment.textured.mesh;
  const Topology shape = topology(mesh);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.non_manifold_edges, 0);
  EXPECT_EQ(shape.loops, static_cast<int>(names.size()));
  EXPECT_EQ(shape.euler(), 2 - static_cast<int>(names.size()));  // genus 0
  EXPECT_EQ(shape.boundary_edges, 2 * shape.vertices - shape.triangles - 2 * shape.euler());
  std::set<std::array<double, 3>> rim_vertices;
  for (const auto& loop : boundary_loops(mesh))
    for (int i : loop) rim_vertices.insert({mesh.vertices[i].x(), mesh.vertices[i].y(), mesh.vertices[i].z()});
  ASSERT_EQ(garment.rims.size(), names.size());
  size_t points = 0;
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(garment.rims[i].name, names[i]);
    points += garment.rims[i].points.size();
    for (const Vector3d& p : garment.rims[i].points) EXPECT_TRUE(rim_vertices.count({p.x(), p.y(), p.z()}));
  }
  EXPECT_EQ(points, rim_vertices.size());
}

// Every vertex, edge middle and triangle middle.
inline void expect_clear(const Mesh& cloth, const Mesh& surface, double clearance_m) {
  const SurfaceDistance tree(surface);
  double worst = 1;
  const auto look = [&](const Vector3d& p) {
    const auto near = tree.closest(p, 0.03);
    if (!near.found) return;
    worst = std::min(worst, near.height);
  };
  for (const Vector3i& t : cloth.triangles) {
    const Vector3d &a = cloth.vertices[t[0]], &b = cloth.vertices[t[1]], &c = cloth.vertices[t[2]];
    for (const Vector3d& p : {a, Vector3d(0.5 * (a + b)), Vector3d((a + b + c) / 3)}) look(p);
  }
  EXPECT_GE(worst, clearance_m);
}

// Lies as cloth does: hardly stretched against its pattern, and nothing meets anything (exact predicates).
inline void expect_at_rest(const Garment& garment, const Mesh& body, const Mesh& under) {
  const Mesh& mesh = garment.textured.mesh;
  Cloth cloth;
  cloth.features = features_of(mesh.triangles);
  cloth.rest_m = garment.rest_m;
  ASSERT_EQ(cloth.rest_m.size(), cloth.features.edges.size());
  EXPECT_LE(strain_quantile(cloth, mesh.vertices, 0.95), 0.05);
  EXPECT_GT(strain_quantile(cloth, mesh.vertices, 0.95), 0.001);  // it did move
  EXPECT_EQ(garment.rest.strain_p95, strain_quantile(cloth, mesh.vertices, 0.95));
  EXPECT_TRUE(garment.rest.settled) << garment.rest.speed_m_per_s;
  EXPECT_EQ(self_intersections(mesh), 0);
  EXPECT_TRUE(crossing_triangles(mesh, body).empty());
  EXPECT_TRUE(crossing_triangles(mesh, under).empty());
}

inline void expect_readable(const TexturedMesh& textured) {
  ASSERT_EQ(textured.corner_uv.size(), textured.mesh.triangles.size());
  ASSERT_FALSE(textured.texture.empty());
  double mirrored = 0, all = 0;
  for (size_t i = 0; i < textured.corner_uv.size(); ++i) {
    const auto& uv = textured.corner_uv[i];
    for (const Vector2f& q : uv) {
      ASSERT_GE(q.minCoeff(), 0.f);
      ASSERT_LE(q.maxCoeff(), 1.f);
    }
    const Vector2f a = uv[1] - uv[0], b = uv[2] - uv[0];
    const Vector3i& t = textured.mesh.triangles[i];
    const auto& v = textured.mesh.vertices;
    const double area = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).norm();
    // Counter-clockwise seen from outside is clockwise where v grows downwards.
    if (a.x() * b.y() - a.y() * b.x() > 0) mirrored += area;
    all += area;
  }
  EXPECT_LT(mirrored, 0.01 * all);
}

}  // namespace dressform
