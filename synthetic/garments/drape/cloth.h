#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "scenes/mesh.h"
#include "synthetic/garments/drape/near_pairs.h"

namespace dressform {

// Cloth as cut: a mesh where it is put on, and the lengths its edges have at rest.
struct Cloth {
  Mesh mesh;
  Features features;           // of the mesh
  std::vector<double> rest_m;  // per edge
  std::vector<char> held;      // per vertex: does not move (a waistband)
};

// At a place, how much longer the cloth is than the surface it is put on as, by direction; symmetric, dimensionless.
using Fullness = std::function<Eigen::Matrix3d(const Vector3d& place)>;

// held: where the cloth is held.
Cloth cloth_as_cut(const Mesh& mesh, const Fullness& fullness, const std::function<bool(const Vector3d&)>& held);

// Every edge halved, every triangle in four: the vertices of `mesh` first, then one per edge in the features' order.
Mesh subdivided(const Mesh& mesh, const Features& features);

// The cloth of `shape` (what it lies on now) with halved edges: rest lengths from `cut`, the mesh as it was put on.
Cloth halved(const Cloth& cloth, const Mesh& cut, const Fullness& fullness);

// |length / rest - 1| that the given part (0 to 1) of the edges does not exceed. Edges between held vertices count too.
double strain_quantile(const Cloth& cloth, const std::vector<Vector3d>& vertices, double part);

}  // namespace dressform
