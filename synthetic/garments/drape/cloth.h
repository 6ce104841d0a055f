#pragma once
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <vector>

#include "scenes/mesh.h"
#include "synthetic/garments/drape/near_pairs.h"

namespace dressform {

// Cloth as cut: a mesh where it is put on, and the lengths its edges have at rest.
struct Cloth {
  Mesh mesh;
  Features features;            // of the mesh
  std::vector<double> rest_m;   // per edge
  std::vector<char> held;       // per vertex: does not move (a waistband)
  std::vector<double> bending;  // per edge: part of the cloth's stiffness against bending; empty: all of it
};

// At a place, how much longer the cloth is than the surface it is put on as, by direction; symmetric, dimensionless.
using Fullness = std::function<Eigen::Matrix3d(const Vector3d& place)>;

// held: where the cloth is held.
Cloth cloth_as_cut(const Mesh& mesh, const Fullness& fullness, const std::function<bool(const Vector3d&)>& held);

// Every edge halved, every triangle in four: the vertices of `mesh` first, then one per edge in the features' order.
// Triangle t becomes 4 t to 4 t + 3: those at its three corners and the middle one (see `quartered`).
Mesh subdivided(const Mesh& mesh, const Features& features);

// Corners of the four triangles that one becomes, in the order of `subdivided`.
template <class Place>
std::array<std::array<Place, 3>, 4> quartered(const std::array<Place, 3>& t) {
  const Place ab = 0.5 * (t[0] + t[1]), bc = 0.5 * (t[1] + t[2]), ca = 0.5 * (t[2] + t[0]);
  return {{{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}};
}

// The cloth of `shape` (what it lies on now) with halved edges: rest lengths from `cut`, the mesh as it was put on.
Cloth halved(const Cloth& cloth, const Mesh& cut, const Fullness& fullness);

// |length / rest - 1| that the given part (0 to 1) of the edges does not exceed. Edges between held vertices count too.
double strain_quantile(const Cloth& cloth, const std::vector<Vector3d>& vertices, double part);

}  // namespace dressform
