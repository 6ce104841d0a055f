#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A regular lattice of points, x fastest. The space between them is cut into tetrahedra along the cubes' main diagonals
// (Freudenthal), so that every point has 14 neighbours and "inside" and "outside" have the same connectivity.
struct Lattice {
  Vector3d origin = Vector3d::Zero();  // of point (0, 0, 0), metres
  double step_m = 0.006;
  std::array<int, 3> size{0, 0, 0};

  std::size_t count() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }
  std::size_t index(int x, int y, int z) const {
    return x + static_cast<std::size_t>(size[0]) * (y + static_cast<std::size_t>(size[1]) * z);
  }
  std::array<int, 3> cell(std::size_t index) const {
    const int x = static_cast<int>(index % size[0]);
    const std::size_t rest = index / size[0];
    return {x, static_cast<int>(rest % size[1]), static_cast<int>(rest / size[1])};
  }
  Vector3d point(int x, int y, int z) const { return origin + step_m * Vector3d(x, y, z); }
  Vector3d point(std::size_t index) const {
    const auto [x, y, z] = cell(index);
    return point(x, y, z);
  }
  bool on_border(int x, int y, int z) const {
    return x == 0 || y == 0 || z == 0 || x == size[0] - 1 || y == size[1] - 1 || z == size[2] - 1;
  }
};

// The lattice around the box, with `margin_m` on every side.
Lattice make_lattice(const Vector3d& low, const Vector3d& high, double margin_m, double step_m);

// What the shaping of a ball-like solid had to leave out.
struct BallReport {
  int cut_points = 0;     // points inside that would have made a handle or belong to another piece
  int filled_points = 0;  // points of enclosed hollows
};

// The field (negative inside) changed where needed so that its inside is one piece without handles or hollows: a ball.
// Where it is none, layers are taken off until it is (which opens what only touches), and grown back by adding points
// that change no topology (simple points: inside and outside neighbours are both connected), deepest first. Points on
// the lattice's border end outside. Returns an empty field when nothing is inside.
std::vector<float> ball_field(const Lattice& lattice, std::vector<float> field, BallReport& report);

// Surface between inside (negative) and outside: marching tetrahedra, which has no ambiguous case. Closed, manifold and
// outward where the field is positive on the lattice's border; as many handles as the inside has.
Mesh lattice_surface(const Lattice& lattice, const std::vector<float>& field);

}  // namespace dressform
