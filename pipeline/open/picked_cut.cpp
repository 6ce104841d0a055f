#include "pipeline/open/picked_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/geometry/path_strip.h"
#include "pipeline/open/fans.h"
#include "pipeline/open/picked_loop.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

constexpr double kWider = 1.2;        // from one try to the next
constexpr double kSegment = 0.5;      // of a mean edge: the longest part of a path, so that it leaves no gap
constexpr double kLeastRound = 0.05;  // of a circle's area: a flatter loop is a line
constexpr double kCapPart = 0.25;  // of the area that a rim encloses: less surface beyond it than this closes nothing

struct Surface3d {
  const Mesh& mesh;
  TriangleNeighbours neighbours;
  std::vector<double> areas;
  std::vector<double> colored;  // area of the triangles that have a rough colour
  double edge_m;
};

Surface3d prepared(const ClosedGarment& closed, double color_m) {
  Surface3d s{closed.mesh, triangle_neighbours(closed.mesh), triangle_areas_m2(closed.mesh), {}, 0};
  s.edge_m = mean_edge_m(closed.mesh);
  s.colored = s.areas;
  const std::vector<double> distances = centroid_distances(closed.mesh, closed.support.points);
  for (std::size_t t = 0; t < distances.size(); ++t)
    if (distances[t] > color_m) s.colored[t] = 0;
  return s;
}

// The piece with most colour, as flags.
std::vector<char> garment_piece(const Surface3d& s, const std::vector<char>& kept) {
  const Pieces pieces = edge_connected_pieces(s.neighbours, kept);
  std::vector<double> color(pieces.count, 0), area(pieces.count, 0);
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t]) color[pieces.of_triangle[t]] += s.colored[t], area[pieces.of_triangle[t]] += s.areas[t];
  int best = 0;
  for (int i = 1; i < pieces.count; ++i)
    if (std::pair(color[i], area[i]) > std::pair(color[best], area[best])) best = i;
  std::vector<char> result(kept.size());
  for (std::size_t t = 0; t < kept.size(); ++t) result[t] = kept[t] && pieces.of_triangle[t] == best;
  return result;
}

// Whether the points go round something, however ragged: a circle of their length would enclose not much more.
bool goes_round(const std::vector<Vector3d>& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) length += (loop[i] - loop[(i + 1) % loop.size()]).norm();
  return enclosed_area_m2(loop) > kLeastRound * length * length / (4 * M_PI);
}

double area_of(const Surface3d& s, const std::vector<char>& flags) {
  double sum = 0;
  for (std::size_t t = 0; t < flags.size(); ++t)
    if (flags[t]) sum += s.areas[t];
  return sum;
}

// Triangles (flags) along a rim's path, as few as part the garment from a cap; or why they do not.
struct Strip {
  std::vector<char> triangles;
  std::string why;
};
Strip parting_strip(const Surface3d& s, const MeshQuery& query, const PickedRim& rim, const PickedCutParams& params) {
  double off_m = 0;
  for (const Vector3d& p : rim.points) off_m = std::max(off_m, query.closest(p).distance);
  if (off_m > params.farthest_m)
    return {{},
            fmt::format("a point of the {} lies {:.0f} mm off the closed surface; expected points on this garment, "
                        "in this capture's frames",
                        rim.name, 1000 * off_m)};
  if (!goes_round(rim.points))
    return {{}, "the points of the " + rim.name + " go round nothing; expected them in order, all round the rim"};
  const auto distances = centroid_distances(s.mesh, path_midpoints(query, rim.points, true, kSegment * s.edge_m));
  const double whole = area_of(s, std::vector<char>(s.areas.size(), 1)),
               least = kCapPart * enclosed_area_m2(rim.points);
  for (double radius = params.narrowest * s.edge_m; radius <= std::max(params.widest_m, params.narrowest * s.edge_m);
       radius *= kWider) {
    Strip strip{std::vector<char>(distances.size()), {}};
    std::vector<char> kept(distances.size());
    for (std::size_t t = 0; t < kept.size(); ++t) strip.triangles[t] = !(kept[t] = distances[t] > radius);
    const double beyond = whole - area_of(s, strip.triangles) - area_of(s, garment_piece(s, kept));
    if (beyond > least) return strip;
  }
  return {{},
          fmt::format("deleting all within {:.0f} mm of the {}'s points, which lie up to {:.0f} mm off the closed "
                      "surface, leaves nothing beyond that would close it; expected points in order all round it",
                      1000 * params.widest_m, rim.name, 1000 * off_m)};
}

// For each rim the piece of the surface that was taken away there; what was taken away elsewhere goes back.
struct Taken {
  Pieces pieces;            // of what is not kept
  std::vector<int> of_rim;  // piece
  std::string why;
};
Taken taken_away(const Surface3d& s, const std::vector<PickedRim>& rims, const std::vector<Strip>& strips,
                 std::vector<char>& kept) {
  std::vector<char> gone(kept.size());
  for (std::size_t t = 0; t < kept.size(); ++t) gone[t] = !kept[t];
  Taken taken{edge_connected_pieces(s.neighbours, gone), {}, {}};
  std::vector<char> at_rim(taken.pieces.count, 0);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    std::vector<double> area(taken.pieces.count, 0);
    for (std::size_t t = 0; t < gone.size(); ++t)
      if (gone[t] && strips[i].triangles[t]) area[taken.pieces.of_triangle[t]] += s.areas[t];
    const int piece = static_cast<int>(std::max_element(area.begin(), area.end()) - area.begin());
    const auto before = std::find(taken.of_rim.begin(), taken.of_rim.end(), piece);
    if (before != taken.of_rim.end())
      taken.why =
          fmt::format("the paths of the {} and the {} run into one another; expected rims apart from each other",
                      rims[before - taken.of_rim.begin()].name, rims[i].name);
    taken.of_rim.push_back(piece);
    at_rim[piece] = 1;
  }
  for (std::size_t t = 0; t < kept.size(); ++t) kept[t] = kept[t] || !at_rim[taken.pieces.of_triangle[t]];
  return taken;
}

// The boundary loops of the kept triangles, each at the rim whose piece lies across.
PickedCut with_boundaries(const Surface3d& s, const Taken& taken, const std::vector<char>& kept,
                          const std::vector<PickedRim>& rims) {
  PickedCut cut;
  std::vector<int> piece_at(s.mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    if (!kept[t]) continue;
    cut.mesh.triangles.push_back(s.mesh.triangles[t]);
    for (int k = 0; k < 3; ++k)
      if (const int across = s.neighbours[t][k]; across >= 0 && !kept[across])
        piece_at[s.mesh.triangles[t][k]] = taken.pieces.of_triangle[across];
  }
  cut.mesh.vertices = s.mesh.vertices;
  cut.boundaries.resize(rims.size());
  std::size_t loops = 0;
  for (auto& loop : boundary_loops(cut.mesh)) {
    ++loops;
    const auto rim = std::find(taken.of_rim.begin(), taken.of_rim.end(), piece_at[loop.front()]);
    if (rim != taken.of_rim.end()) cut.boundaries[rim - taken.of_rim.begin()] = std::move(loop);
  }
  for (std::size_t i = 0; i < rims.size(); ++i)
    if (cut.boundaries[i].size() < 3) return {{}, {}, "nothing of the garment is left at its " + rims[i].name};
  if (loops != rims.size()) return {{}, {}, fmt::format("the cut left {} rims; expected {}", loops, rims.size())};
  return cut;
}

}  // namespace

PickedCut cut_along(const ClosedGarment& closed, const std::vector<PickedRim>& rims, const PickedCutParams& params) {
  const Surface3d s = prepared(closed, params.color_m);
  const MeshQuery query(closed.mesh);
  std::vector<Strip> strips;
  std::vector<char> kept(closed.mesh.triangles.size(), 1);
  for (const PickedRim& rim : rims) {
    strips.push_back(parting_strip(s, query, rim, params));
    if (!strips.back().why.empty()) return {{}, {}, strips.back().why};
    for (std::size_t t = 0; t < kept.size(); ++t) kept[t] = kept[t] && !strips.back().triangles[t];
  }
  const auto garment = [&](const std::vector<char>& flags) { return garment_piece(s, flags); };
  kept = with_single_fans(s.mesh, s.neighbours, garment(kept), garment);
  const Taken taken = taken_away(s, rims, strips, kept);
  if (!taken.why.empty()) return {{}, {}, taken.why};
  return with_boundaries(s, taken, kept, rims);
}

}  // namespace dressform
