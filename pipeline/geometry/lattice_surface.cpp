#include <algorithm>
#include <array>

#include "pipeline/geometry/lattice.h"

namespace dressform {
namespace {

constexpr double kNearest = 0.02;  // of an edge: no vertex comes nearer to a point, so that no triangle vanishes

std::array<std::ptrdiff_t, 7> corner_steps(const Lattice& lattice) {
  std::array<std::ptrdiff_t, 7> result{};
  for (int bits = 1; bits < 8; ++bits)
    result[bits - 1] = static_cast<std::ptrdiff_t>(lattice.index(bits & 1, bits >> 1 & 1, bits >> 2 & 1));
  return result;
}

struct SurfaceBuilder {
  const Lattice& lattice;
  const std::vector<float>& field;
  std::array<std::ptrdiff_t, 7> step;    // from a point to the corner of its cube with coordinates of the bits 1 to 7
  std::vector<std::array<int, 7>> rows;  // vertex numbers of the edges from the points of two slabs
  Mesh mesh;

  SurfaceBuilder(const Lattice& l, const std::vector<float>& f) : lattice(l), field(f), step(corner_steps(l)) {
    rows.assign(2 * static_cast<std::size_t>(l.size[0]) * l.size[1], empty_row());
  }
  static std::array<int, 7> empty_row() { return {-1, -1, -1, -1, -1, -1, -1}; }

  // The crossing on the edge from point a to its neighbour b = a + offset of bits (b > a).
  int vertex(std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    const auto found = std::find(step.begin(), step.end(), static_cast<std::ptrdiff_t>(b - a));
    int& number = rows[a % rows.size()][found - step.begin()];
    if (number >= 0) return number;
    const double fa = field[a], fb = field[b];
    const double t = std::clamp(fa / (fa - fb), kNearest, 1 - kNearest);
    number = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(lattice.point(a) + t * (lattice.point(b) - lattice.point(a)));
    return number;
  }

  void add(int a, int b, int c, bool flip) { mesh.triangles.push_back(flip ? Vector3i(a, c, b) : Vector3i(a, b, c)); }

  // p: four points of a tetrahedron of positive volume.
  void tetrahedron(const std::array<std::size_t, 4>& p, bool mirrored) {
    int in[4], out[4], inside = 0, outside = 0;
    for (int k = 0; k < 4; ++k) (field[p[k]] < 0 ? in[inside++] : out[outside++]) = k;
    if (inside == 0 || inside == 4) return;
    if (inside == 1 || inside == 3) {
      const int apex = inside == 1 ? in[0] : out[0];
      const int* others = inside == 1 ? out : in;
      // Seen from the apex, the other three in their order turn clockwise for an even place of the apex.
      const bool flip = (apex % 2 == 0) != (inside == 1);
      add(vertex(p[apex], p[others[0]]), vertex(p[apex], p[others[1]]), vertex(p[apex], p[others[2]]),
          flip != mirrored);
      return;
    }
    const int v00 = vertex(p[in[0]], p[out[0]]), v01 = vertex(p[in[0]], p[out[1]]);
    const int v10 = vertex(p[in[1]], p[out[0]]), v11 = vertex(p[in[1]], p[out[1]]);
    // (in0, in1, out0, out1) is an even or odd order of the four.
    const int order[4] = {in[0], in[1], out[0], out[1]};
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
    const bool flip = (inversions % 2 == 1) != mirrored;
    add(v00, v01, v11, flip);
    add(v00, v11, v10, flip);
  }

  void cube(int x, int y, int z) {
    // The six ways from (0,0,0) to (1,1,1); even orders of the axes give a positive volume.
    static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const std::size_t base = lattice.index(x, y, z);
    bool any_in = false, any_out = false;
    for (int i = 0; i < 8; ++i) {
      const bool inside = field[base + (i ? step[i - 1] : 0)] < 0;
      any_in |= inside;
      any_out |= !inside;
    }
    if (!any_in || !any_out) return;
    for (int k = 0; k < 6; ++k) {
      int bits = 0;
      std::array<std::size_t, 4> p{base, 0, 0, 0};
      for (int i = 0; i < 3; ++i) {
        bits |= 1 << kOrders[k][i];
        p[i + 1] = base + step[bits - 1];
      }
      tetrahedron(p, k >= 3);
    }
  }
};

}  // namespace

Mesh lattice_surface(const Lattice& lattice, const std::vector<float>& field) {
  SurfaceBuilder builder(lattice, field);
  const std::size_t slab = static_cast<std::size_t>(lattice.size[0]) * lattice.size[1];
  for (int z = 0; z + 1 < lattice.size[2]; ++z) {
    // The numbers of slab z + 1 replace those of slab z - 1.
    std::fill_n(builder.rows.begin() + ((z + 1) % 2) * slab, slab, SurfaceBuilder::empty_row());
    for (int y = 0; y + 1 < lattice.size[1]; ++y)
      for (int x = 0; x + 1 < lattice.size[0]; ++x) builder.cube(x, y, z);
  }
  return std::move(builder.mesh);
}

}  // namespace dressform
