#include "synthetic/geometry/contour.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "synthetic/geometry/contour_grid.h"

namespace dressform {
namespace {

constexpr int kBlock = ContourGrid::kBlock;

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

// Which surface patch of a cell crosses each edge (-1: none), and how many patches there are.
struct Patches {
  std::array<std::int8_t, 12> of_edge;
  int count = 0;
};

// On a face with four crossings each inside corner is cut off by itself, or, where the bit of the face is set in
// `joined`, each outside corner; both cells at the face must be asked alike.
Patches patches_of(int sign, int joined) {
  std::array<int, 12> parent;
  for (int e = 0; e < 12; ++e) parent[e] = e;
  const auto root = [&](int e) {
    while (parent[e] != e) e = parent[e];
    return e;
  };
  const auto inside = [&](int corner) { return (sign >> corner & 1) != 0; };
  for (int f = 0; f < 6; ++f) {
    const auto& face = kFaceCorners[f];
    std::array<int, 4> crossed;
    int crossings = 0;
    for (int i = 0; i < 4; ++i)
      if (inside(face[i]) != inside(face[(i + 1) % 4])) crossed[crossings++] = edge_between(face[i], face[(i + 1) % 4]);
    if (crossings == 2) parent[root(crossed[0])] = root(crossed[1]);
    if (crossings == 4)
      for (int i = 0; i < 4; ++i)
        if (inside(face[i]) != ((joined >> f & 1) != 0))
          parent[root(edge_between(face[i], face[(i + 3) % 4]))] = root(edge_between(face[i], face[(i + 1) % 4]));
  }
  Patches patches;
  std::array<int, 12> number;
  number.fill(-1);
  for (int e = 0; e < 12; ++e) {
    patches.of_edge[e] = -1;
    if (inside(kEdgeCorners[e][0]) == inside(kEdgeCorners[e][1])) continue;
    int& n = number[root(e)];
    if (n < 0) n = patches.count++;
    patches.of_edge[e] = static_cast<std::int8_t>(n);
  }
  return patches;
}

// Builds one vertex per surface patch of a cell and one quad per crossed grid edge.
class DualMesher {
 public:
  explicit DualMesher(ContourGrid grid) : grid_(std::move(grid)), first_vertex_(grid_.values.size(), -1) {
    for (int sign = 0; sign < 256; ++sign) table_[sign] = patches_of(sign, 0);
  }

  Mesh run() {
    // What is joined in one place may pinch in the next: a few rounds settle it.
    for (int round = 0; round < 4; ++round) {
      const auto before = joined_.size();
      for_cells([this](int x, int y, int z) { join_pinched(x, y, z); });
      if (joined_.size() == before) break;
    }
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

  Patches patches(int x, int y, int z) const {
    const int sign = signs(x, y, z);
    if (joined_.empty()) return table_[sign];
    const auto found = joined_.find(grid_.at(x, y, z));
    return found == joined_.end() ? table_[sign] : patches_of(sign, found->second);
  }

  // A face with four crossings that lie in one patch on both of its sides is a tunnel with nothing but an edge round
  // it, where four triangles would meet (Wenger, "Isosurfaces", 2013, 3.3.5): its inside corners are joined instead.
  void join_pinched(int x, int y, int z) {
    constexpr int kFar[3] = {1, 3, 5};  // the face towards the next cell along each axis; the one before it is opposite
    const int sign = signs(x, y, z);
    if (sign == 0 || sign == 255) return;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3i next = Vector3i(x, y, z) + Vector3i::Unit(axis);
      if (next[axis] + 1 >= grid_.size[axis]) continue;
      if (!in_one_patch(sign, patches(x, y, z), kFar[axis])) continue;
      if (!in_one_patch(signs(next.x(), next.y(), next.z()), patches(next.x(), next.y(), next.z()), kFar[axis] - 1))
        continue;
      joined_[grid_.at(x, y, z)] |= 1 << kFar[axis];
      joined_[grid_.at(next.x(), next.y(), next.z())] |= 1 << (kFar[axis] - 1);
    }
  }

  static bool in_one_patch(int sign, const Patches& patches, int f) {
    const auto& face = kFaceCorners[f];
    for (int i = 0; i < 4; ++i)
      if ((sign >> face[i] & 1) == (sign >> face[(i + 1) % 4] & 1)) return false;
    for (int i = 0; i < 3; ++i)
      if (patches.of_edge[edge_between(face[i], face[i + 1])] != patches.of_edge[edge_between(face[0], face[3])])
        return false;
    return true;
  }

  void add_vertices(int x, int y, int z) {
    const Patches cell = patches(x, y, z);
    if (cell.count == 0) return;
    std::array<Vector3d, 4> sum;
    std::array<int, 4> crossings{};
    sum.fill(Vector3d::Zero());
    for (int e = 0; e < 12; ++e) {
      const int patch = cell.of_edge[e];
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
    for (int i = 0; i < cell.count; ++i) mesh_.vertices.push_back(sum[i] / crossings[i]);
  }

  // The vertex of cell (x, y, z) for the patch that crosses edge e of that cell.
  int vertex(int x, int y, int z, int e) const {
    return first_vertex_[grid_.at(x, y, z)] + patches(x, y, z).of_edge[e];
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

  const ContourGrid grid_;
  std::array<Patches, 256> table_;
  std::map<size_t, int> joined_;  // cells at whose faces inside corners are joined: bits of the faces
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

std::optional<Mesh> closed_contour(const Field& field, const Eigen::AlignedBox3d& box, double step_m) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    const Vector3d shift = attempt * Vector3d(0.13, 0.17, 0.19);
    Mesh mesh = DualMesher(sample_near_surface(field, box, step_m, shift)).run();
    if (mesh.triangles.empty()) throw std::runtime_error("contour: the field has no surface inside the box");
    if (!topology(mesh).closed()) continue;
    relax(field, mesh, 3);
    return mesh;
  }
  return std::nullopt;
}

Mesh contour(const Field& field, const Eigen::AlignedBox3d& box, double step_m) {
  std::optional<Mesh> mesh = closed_contour(field, box, step_m);
  if (!mesh) throw std::runtime_error("contour: no placement of the grid gives a closed manifold");
  return std::move(*mesh);
}

}  // namespace dressform
