#include "synthetic/contour.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dressform {
namespace {

constexpr int kBlock = 8;

// Samples of the field on a grid; only blocks of cells near the surface are sampled exactly.
struct Grid {
  Vector3d origin;
  double step;
  Vector3i size;  // samples along x, y, z
  std::vector<float> values;
  std::vector<std::uint8_t> sampled;  // per block of cells
  Vector3i blocks;

  size_t at(int x, int y, int z) const { return (static_cast<size_t>(z) * size.y() + y) * size.x() + x; }
  Vector3d point(int x, int y, int z) const { return origin + step * Vector3d(x, y, z); }
};

Grid sample_field(const Field& field, const Eigen::AlignedBox3d& box, double step, const Vector3d& shift) {
  Grid grid;
  grid.step = step;
  grid.origin = box.min() - (Vector3d::Constant(2) - shift) * step;
  for (int k = 0; k < 3; ++k) grid.blocks[k] = static_cast<int>(std::ceil((box.sizes()[k] / step + 4) / kBlock));
  grid.size = grid.blocks * kBlock + Vector3i::Ones();
  grid.values.assign(static_cast<size_t>(grid.size.x()) * grid.size.y() * grid.size.z(), 0.f);
  grid.sampled.assign(static_cast<size_t>(grid.blocks.prod()), 0);
  // A block holds the samples [8 b, 8 b + 8) of each axis; the last block also holds the samples at the far side.
  tbb::parallel_for(0, grid.blocks.prod(), [&](int index) {
    const Vector3i b(index % grid.blocks.x(), index / grid.blocks.x() % grid.blocks.y(),
                     index / (grid.blocks.x() * grid.blocks.y()));
    const Vector3d center = grid.origin + step * kBlock * (b.cast<double>() + Vector3d::Constant(0.5));
    const double reach = 0.5 * std::sqrt(3.0) * (kBlock + 1) * step;
    const double middle = field(center);
    const bool near = std::abs(middle) < 2 * reach;
    grid.sampled[index] = near;
    Vector3i end = (b + Vector3i::Ones()) * kBlock;
    for (int k = 0; k < 3; ++k) end[k] += b[k] == grid.blocks[k] - 1;
    for (int z = b.z() * kBlock; z < end.z(); ++z)
      for (int y = b.y() * kBlock; y < end.y(); ++y)
        for (int x = b.x() * kBlock; x < end.x(); ++x) {
          const double value = near ? field(grid.point(x, y, z)) : middle;
          grid.values[grid.at(x, y, z)] = value == 0 ? 1e-9f : static_cast<float>(value);
        }
  });
  return grid;
}

// Corner i of a cell is at (i & 1, i >> 1 & 1, i >> 2). Edges 0-3 run along x, 4-7 along y, 8-11 along z.
constexpr int kEdgeCorners[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                     {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr int kFaceCorners[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};

int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e)
    if ((kEdgeCorners[e][0] == a && kEdgeCorners[e][1] == b) || (kEdgeCorners[e][0] == b && kEdgeCorners[e][1] == a))
      return e;
  return -1;
}

// For each of the 256 sign patterns, which surface patch of the cell crosses each edge (-1: none). On a face with four
// crossings each inside corner is cut off by itself; both cells at the face decide alike.
struct PatchTable {
  std::array<std::array<std::int8_t, 12>, 256> patch;
  std::array<int, 256> count;

  PatchTable() {
    for (int sign = 0; sign < 256; ++sign) fill(sign);
  }

  void fill(int sign) {
    std::array<int, 12> parent;
    for (int e = 0; e < 12; ++e) parent[e] = e;
    const auto root = [&](int e) {
      while (parent[e] != e) e = parent[e];
      return e;
    };
    const auto inside = [&](int corner) { return (sign >> corner & 1) != 0; };
    for (const auto& face : kFaceCorners) {
      std::vector<int> crossed;
      for (int i = 0; i < 4; ++i)
        if (inside(face[i]) != inside(face[(i + 1) % 4])) crossed.push_back(edge_between(face[i], face[(i + 1) % 4]));
      if (crossed.size() == 2) parent[root(crossed[0])] = root(crossed[1]);
      if (crossed.size() == 4)
        for (int i = 0; i < 4; ++i)
          if (inside(face[i]))
            parent[root(edge_between(face[i], face[(i + 3) % 4]))] = root(edge_between(face[i], face[(i + 1) % 4]));
    }
    std::array<int, 12> number;
    number.fill(-1);
    count[sign] = 0;
    for (int e = 0; e < 12; ++e) {
      patch[sign][e] = -1;
      if (inside(kEdgeCorners[e][0]) == inside(kEdgeCorners[e][1])) continue;
      int& n = number[root(e)];
      if (n < 0) n = count[sign]++;
      patch[sign][e] = static_cast<std::int8_t>(n);
    }
  }
};

// Builds one vertex per surface patch of a cell and one quad per crossed grid edge.
class DualMesher {
 public:
  explicit DualMesher(const Grid& grid) : grid_(grid), first_vertex_(grid.values.size(), -1) {}

  Mesh run() {
    for_cells([this](int x, int y, int z) { add_vertices(x, y, z); });
    for_cells([this](int x, int y, int z) { add_quads(x, y, z); });
    return std::move(mesh_);
  }

 private:
  template <class Visit>
  void for_cells(const Visit& visit) {
    for (int z = 0; z + 1 < grid_.size.z(); ++z)
      for (int y = 0; y + 1 < grid_.size.y(); ++y)
        for (int bx = 0; bx < grid_.blocks.x(); ++bx) {
          if (!block_sampled(bx, y / kBlock, z / kBlock)) continue;
          for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x) visit(x, y, z);
        }
  }
  bool block_sampled(int x, int y, int z) const {
    return grid_.sampled[(static_cast<size_t>(z) * grid_.blocks.y() + y) * grid_.blocks.x() + x];
  }
  int signs(int x, int y, int z) const {
    int sign = 0;
    for (int i = 0; i < 8; ++i)
      if (grid_.values[grid_.at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2))] < 0) sign |= 1 << i;
    return sign;
  }

  void add_vertices(int x, int y, int z) {
    const int sign = signs(x, y, z);
    if (sign == 0 || sign == 255) return;
    const int count = table_.count[sign];
    std::array<Vector3d, 4> sum;
    std::array<int, 4> crossings{};
    sum.fill(Vector3d::Zero());
    for (int e = 0; e < 12; ++e) {
      const int patch = table_.patch[sign][e];
      if (patch < 0) continue;
      const int a = kEdgeCorners[e][0], b = kEdgeCorners[e][1];
      const double fa = grid_.values[grid_.at(x + (a & 1), y + (a >> 1 & 1), z + (a >> 2))];
      const double fb = grid_.values[grid_.at(x + (b & 1), y + (b >> 1 & 1), z + (b >> 2))];
      const Vector3d pa = grid_.point(x + (a & 1), y + (a >> 1 & 1), z + (a >> 2));
      const Vector3d pb = grid_.point(x + (b & 1), y + (b >> 1 & 1), z + (b >> 2));
      sum[patch] += pa + fa / (fa - fb) * (pb - pa);
      ++crossings[patch];
    }
    first_vertex_[grid_.at(x, y, z)] = static_cast<int>(mesh_.vertices.size());
    for (int i = 0; i < count; ++i) mesh_.vertices.push_back(sum[i] / crossings[i]);
  }

  // The vertex of cell (x, y, z) for the patch that crosses edge e of that cell.
  int vertex(int x, int y, int z, int e) const {
    return first_vertex_[grid_.at(x, y, z)] + table_.patch[signs(x, y, z)][e];
  }

  // The three grid edges that leave sample (x, y, z), each shared by four cells.
  void add_quads(int x, int y, int z) {
    if (x == 0 || y == 0 || z == 0) return;
    const bool inside = grid_.values[grid_.at(x, y, z)] < 0;
    if (inside != (grid_.values[grid_.at(x + 1, y, z)] < 0))
      quad(vertex(x, y - 1, z - 1, 3), vertex(x, y, z - 1, 2), vertex(x, y, z, 0), vertex(x, y - 1, z, 1), inside);
    if (inside != (grid_.values[grid_.at(x, y + 1, z)] < 0))
      quad(vertex(x - 1, y, z - 1, 7), vertex(x - 1, y, z, 5), vertex(x, y, z, 4), vertex(x, y, z - 1, 6), inside);
    if (inside != (grid_.values[grid_.at(x, y, z + 1)] < 0))
      quad(vertex(x - 1, y - 1, z, 11), vertex(x, y - 1, z, 10), vertex(x, y, z, 8), vertex(x - 1, y, z, 9), inside);
  }

  void quad(int a, int b, int c, int d, bool outward) {
    if (!outward) std::swap(b, d);
    const auto& v = mesh_.vertices;
    if ((v[a] - v[c]).squaredNorm() <= (v[b] - v[d]).squaredNorm()) {
      mesh_.triangles.emplace_back(a, b, c);
      mesh_.triangles.emplace_back(a, c, d);
    } else {
      mesh_.triangles.emplace_back(a, b, d);
      mesh_.triangles.emplace_back(b, c, d);
    }
  }

  const Grid& grid_;
  const PatchTable table_;
  std::vector<int> first_vertex_;
  Mesh mesh_;
};

Vector3d gradient(const Field& field, const Vector3d& p) {
  constexpr double kDelta = 2e-4;
  Vector3d g;
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = kDelta * Vector3d::Unit(k);
    g[k] = (field(p + d) - field(p - d)) / (2 * kDelta);
  }
  return g;
}

// Moves every vertex half way to the mean of its neighbours, then back onto the surface: even, well-shaped triangles.
void relax(const Field& field, Mesh& mesh, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vector3d> sum(mesh.vertices.size(), Vector3d::Zero());
    std::vector<int> count(mesh.vertices.size(), 0);
    for (const Vector3i& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        sum[t[k]] += mesh.vertices[t[(k + 1) % 3]] + mesh.vertices[t[(k + 2) % 3]];
        count[t[k]] += 2;
      }
    for (size_t i = 0; i < sum.size(); ++i) mesh.vertices[i] = 0.5 * (mesh.vertices[i] + sum[i] / count[i]);
    project_to_surface(field, mesh.vertices, 1);
  }
  project_to_surface(field, mesh.vertices, 2);
}

}  // namespace

void project_to_surface(const Field& field, std::vector<Vector3d>& points, int iterations) {
  tbb::parallel_for(size_t{0}, points.size(), [&](size_t i) {
    for (int k = 0; k < iterations; ++k) {
      const Vector3d g = gradient(field, points[i]);
      const double slope = g.squaredNorm();
      if (slope < 0.01) return;
      Vector3d step = field(points[i]) / slope * g;
      const double length = step.norm();
      if (length > 0.005) step *= 0.005 / length;  // a crease of the field must not throw the vertex away
      points[i] -= step;
    }
  });
}

Mesh contour(const Field& field, const Eigen::AlignedBox3d& box, double step_m) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    const Vector3d shift = attempt * Vector3d(0.13, 0.17, 0.19);
    Mesh mesh = DualMesher(sample_field(field, box, step_m, shift)).run();
    if (mesh.triangles.empty()) throw std::runtime_error("contour: the field has no surface inside the box");
    if (!topology(mesh).closed()) continue;
    relax(field, mesh, 3);
    return mesh;
  }
  throw std::runtime_error("contour: no placement of the grid gives a closed manifold");
}

}  // namespace dressform
