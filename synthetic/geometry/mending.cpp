#include "synthetic/geometry/mending.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "scenes/disjoint_sets.h"
#include "scenes/error.h"
#include "scenes/mesh_sides.h"
#include "scenes/triangle.h"
#include "synthetic/geometry/joined_rims.h"

namespace dressform {
namespace {

// Pieces of triangles that share edges of exactly two.
DisjointSets smooth_pieces(const Mesh& mesh, const std::vector<TriangleSide>& sides) {
  DisjointSets pieces(mesh.triangles.size());
  for_edges(sides, [&](const TriangleSide* first, const TriangleSide* last) {
    if (last - first == 2) pieces.join(first[0].triangle, first[1].triangle);
  });
  return pieces;
}

// Away from the edge, in the triangle's plane; zero where it has no area.
Vector3d direction_from_edge(const Mesh& mesh, const TriangleSide& side) {
  const Vector3i& t = mesh.triangles[side.triangle];
  const Vector3d a = mesh.vertices[side.low], edge = (mesh.vertices[side.high] - a).stableNormalized();
  const Vector3d to = mesh.vertices[t[(side.k + 2) % 3]] - a;
  return Vector3d(to - to.dot(edge) * edge).stableNormalized();
}

using SidePair = std::pair<TriangleSide, TriangleSide>;

// Which sides of one edge go on into one another.
void pair_sides(const Mesh& mesh, DisjointSets& pieces, std::vector<TriangleSide> sides, std::vector<SidePair>& pairs) {
  while (sides.size() > 1) {
    std::size_t best_a = 0, best_b = 1;
    double best = INFINITY;
    for (std::size_t a = 0; a < sides.size(); ++a)
      for (std::size_t b = a + 1; b < sides.size(); ++b) {
        const bool one_piece = pieces.root(sides[a].triangle) == pieces.root(sides[b].triangle);
        constexpr double kOtherPiece = 4;  // more than any bend, which is -1 (flat) to 1 (folded)
        const double bend = direction_from_edge(mesh, sides[a]).dot(direction_from_edge(mesh, sides[b])) +
                            (one_piece ? 0 : kOtherPiece);
        if (bend >= best) continue;
        best = bend;
        best_a = a;
        best_b = b;
      }
    pairs.emplace_back(sides[best_a], sides[best_b]);
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(best_b));
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(best_a));
  }
}

// The corner of the side's triangle at `vertex`, numbered through.
int corner_at(const Mesh& mesh, const TriangleSide& side, int vertex) {
  const int k = mesh.triangles[side.triangle][side.k] == vertex ? side.k : (side.k + 1) % 3;
  return 3 * side.triangle + k;
}

// Takes overused edges apart: corners are one vertex only where their triangles go on into one another.
void part_overused_edges(Mesh& mesh) {
  const std::vector<TriangleSide> sides = sorted_sides(mesh);
  bool any = false;
  for_edges(sides, [&](const TriangleSide* first, const TriangleSide* last) { any = any || last - first > 2; });
  if (!any) return;
  DisjointSets pieces = smooth_pieces(mesh, sides), corners(3 * mesh.triangles.size());
  std::vector<SidePair> pairs;
  for_edges(sides, [&](const TriangleSide* first, const TriangleSide* last) {
    pair_sides(mesh, pieces, {first, last}, pairs);
  });
  for (const auto& [a, b] : pairs)
    for (int vertex : {a.low, a.high}) corners.join(corner_at(mesh, a, vertex), corner_at(mesh, b, vertex));
  Mesh result;
  std::vector<int> number(3 * mesh.triangles.size(), -1);
  result.triangles.resize(mesh.triangles.size());
  for (int c = 0; c < static_cast<int>(number.size()); ++c) {
    const int root = corners.root(c);
    if (number[root] < 0) {
      number[root] = static_cast<int>(result.vertices.size());
      result.vertices.push_back(mesh.vertices[mesh.triangles[c / 3][c % 3]]);
    }
    result.triangles[c / 3][c % 3] = number[root];
  }
  mesh = std::move(result);
}

void turn(TexturedMesh& textured, std::size_t t) {
  std::swap(textured.mesh.triangles[t][1], textured.mesh.triangles[t][2]);
  if (!textured.corner_uv.empty()) std::swap(textured.corner_uv[t][1], textured.corner_uv[t][2]);
}

struct Neighbour {
  int triangle = -1;
  bool turned = false;  // against this one
};

std::vector<std::array<Neighbour, 3>> neighbours(const Mesh& mesh) {
  std::vector<std::array<Neighbour, 3>> result(mesh.triangles.size());
  for_edges(sorted_sides(mesh), [&](const TriangleSide* first, const TriangleSide* last) {
    if (last - first != 2) return;
    const TriangleSide &a = first[0], &b = first[1];
    const bool turned = mesh.triangles[a.triangle][a.k] == mesh.triangles[b.triangle][b.k];
    result[a.triangle][a.k] = {b.triangle, turned};
    result[b.triangle][b.k] = {a.triangle, turned};
  });
  return result;
}

// Finds the pieces, and for each triangle whether it is turned against its piece's first.
struct Sides {
  std::vector<int> piece;
  std::vector<char> turned;
  int pieces = 0;
};
Sides walk_pieces(const Mesh& mesh, const std::string& where) {
  const auto beside = neighbours(mesh);
  Sides result{std::vector<int>(mesh.triangles.size(), -1), std::vector<char>(mesh.triangles.size(), 0), 0};
  std::vector<int> open;
  int conflicts = 0;
  Vector3d place = Vector3d::Zero();
  for (int start = 0; start < static_cast<int>(mesh.triangles.size()); ++start) {
    if (result.piece[start] >= 0) continue;
    result.piece[start] = result.pieces++;
    open.assign(1, start);
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (const Neighbour& next : beside[t]) {
        if (next.triangle < 0) continue;
        const char turned = static_cast<char>(result.turned[t] != static_cast<char>(next.turned));
        if (result.piece[next.triangle] < 0) {
          result.piece[next.triangle] = result.piece[t];
          result.turned[next.triangle] = turned;
          open.push_back(next.triangle);
        } else if (result.turned[next.triangle] != turned && conflicts++ == 0) {
          place = mesh.vertices[mesh.triangles[t][0]];
        }
      }
    }
  }
  if (conflicts > 0)
    throw InputError(where, fmt::format("found a one-sided surface: {} edges, the first at ({:.3f}, {:.3f}, {:.3f}) m, "
                                        "where it turns over; expected a surface with an outer side",
                                        (conflicts + 1) / 2, place.x(), place.y(), place.z()));
  return result;
}

// Numbers pieces by area and returns their areas.
std::vector<double> sort_pieces(const Mesh& mesh, Sides& sides) {
  std::vector<double> area(static_cast<std::size_t>(sides.pieces), 0), sorted;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[sides.piece[t]] += triangle_area_m2(mesh, mesh.triangles[t]);
  std::vector<int> order(area.size()), rank(area.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<int>(i);
    sorted.push_back(area[order[i]]);
  }
  for (int& piece : sides.piece) piece = rank[piece];
  return sorted;
}

// Where the largest piece is, by area.
Vector3d middle_of_largest(const Mesh& mesh, const std::vector<int>& piece) {
  Vector3d sum = Vector3d::Zero();
  double weight = 0;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    if (piece[t] != 0) continue;
    const Vector3i& c = mesh.triangles[t];
    const double area = triangle_area_m2(mesh, c);
    sum += area / 3 * (mesh.vertices[c[0]] + mesh.vertices[c[1]] + mesh.vertices[c[2]]);
    weight += area;
  }
  return weight > 0 ? Vector3d(sum / weight) : sum;
}

// Turns triangles with their pieces, and pieces outwards: the volume between them and the middle is positive.
void turn_outwards(TexturedMesh& textured, const Sides& sides) {
  for (std::size_t t = 0; t < sides.turned.size(); ++t)
    if (sides.turned[t]) turn(textured, t);
  const Mesh& mesh = textured.mesh;
  const Vector3d middle = middle_of_largest(mesh, sides.piece);
  std::vector<double> volume(static_cast<std::size_t>(sides.pieces), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3i& c = mesh.triangles[t];
    volume[sides.piece[t]] +=
        (mesh.vertices[c[0]] - middle).dot((mesh.vertices[c[1]] - middle).cross(mesh.vertices[c[2]] - middle));
  }
  for (std::size_t t = 0; t < sides.piece.size(); ++t)
    if (volume[sides.piece[t]] < 0) turn(textured, t);
}

void check_edges(const Mesh& mesh, const std::string& where) {
  int overused = 0;
  Vector3d place = Vector3d::Zero();
  for_edges(sorted_sides(mesh), [&](const TriangleSide* first, const TriangleSide* last) {
    if (last - first > 2 && overused++ == 0) place = 0.5 * (mesh.vertices[first->low] + mesh.vertices[first->high]);
  });
  if (overused > 0)
    throw InputError(where,
                     fmt::format("found {} edges that more than two faces share and that cannot be taken apart, the "
                                 "first at ({:.3f}, {:.3f}, {:.3f}) m; expected a manifold surface",
                                 overused, place.x(), place.y(), place.z()));
}

}  // namespace

MendedMesh mended(TexturedMesh textured, const std::string& where) {
  textured = joined_rims(std::move(textured));
  part_overused_edges(textured.mesh);
  check_edges(textured.mesh, where);
  MendedMesh result;
  Sides sides = walk_pieces(textured.mesh, where);
  result.area_m2 = sort_pieces(textured.mesh, sides);
  turn_outwards(textured, sides);
  textured.mesh = compacted(textured.mesh);
  result.textured = std::move(textured);
  result.piece = std::move(sides.piece);
  return result;
}

Mesh piece_of(const MendedMesh& mesh, int piece) {
  Mesh result{mesh.textured.mesh.vertices, {}};
  for (std::size_t t = 0; t < mesh.piece.size(); ++t)
    if (mesh.piece[t] == piece) result.triangles.push_back(mesh.textured.mesh.triangles[t]);
  return compacted(result);
}

}  // namespace dressform
