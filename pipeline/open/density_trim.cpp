// The habit with Poisson's surface, as in Open3D's tutorial: vertices where the points are thin are taken off by a
// quantile of the density (the screened form's own measure: Kazhdan and Hoppe, ACM TOG 2013; here the distance to a
// near point, which the points tell). Rims come out where points end. Small holes within the cloth are kept closed, as
// a person would close them.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "pipeline/garment/sleeves.h"
#include "pipeline/geometry/path_strip.h"
#include "pipeline/geometry/submesh.h"
#include "pipeline/open/fans.h"
#include "pipeline/open/flaw.h"
#include "pipeline/open/open.h"
#include "pipeline/open/open_scene.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/support_distance.h"
#include "scenes/statistics.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

struct DensityTrimParams {
  double quantile = 0.1;
  int neighbours = 5;
  double smallest_hole_m2 = 0.002;
};
template <class V>
void fields(V& v, DensityTrimParams& p) {
  v("quantile", p.quantile, 0.001, 0.9, "", "part of the vertices, those of the thinnest points, that is taken off");
  v("neighbours", p.neighbours, 1, 100, "", "the distance to this nearest point is a vertex's density");
  v("smallest_hole_m2", p.smallest_hole_m2, 0.0, 1.0, "m2", "smaller pieces that would come off stay");
}

// The largest piece (by triangles) of those kept.
std::vector<char> largest_piece(const TriangleNeighbours& neighbours, const std::vector<char>& kept) {
  const Pieces pieces = edge_connected_pieces(neighbours, kept);
  std::vector<int> sizes(static_cast<std::size_t>(pieces.count), 0);
  for (const int piece : pieces.of_triangle)
    if (piece >= 0) ++sizes[piece];
  std::vector<char> result(kept.size(), 0);
  if (sizes.empty()) return result;
  const auto best = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  for (std::size_t t = 0; t < kept.size(); ++t) result[t] = pieces.of_triangle[t] == best;
  return result;
}

// Triangles to keep: those of no trimmed vertex, and small pieces of the others.
std::vector<char> kept_triangles(const Mesh& mesh, const TriangleNeighbours& neighbours, const PointCloud& support,
                                 const DensityTrimParams& params) {
  const std::vector<double> far = support_distances(mesh.vertices, support.points, params.neighbours);
  const auto at = static_cast<std::size_t>((1 - params.quantile) * static_cast<double>(far.size()));
  const double limit = nth_value(far, std::min(at, far.size() - 1));
  std::vector<char> off(mesh.triangles.size(), 0), kept(mesh.triangles.size(), 1);
  for (std::size_t t = 0; t < off.size(); ++t)
    for (const int v : mesh.triangles[t]) off[t] = off[t] || far[v] > limit;
  const Pieces pieces = edge_connected_pieces(neighbours, off);
  const std::vector<double> areas = triangle_areas_m2(mesh);
  std::vector<double> sizes(static_cast<std::size_t>(pieces.count), 0);
  for (std::size_t t = 0; t < off.size(); ++t)
    if (off[t]) sizes[pieces.of_triangle[t]] += areas[t];
  for (std::size_t t = 0; t < off.size(); ++t)
    kept[t] = !off[t] || sizes[pieces.of_triangle[t]] < params.smallest_hole_m2;
  return kept;
}

// The opening that most of a loop's points are near to.
const Opening* opening_of(const std::vector<Vector3d>& loop, const std::vector<Opening>& openings,
                          const OpenScene& scene) {
  std::map<std::string, int> votes;
  for (const Vector3d& p : loop)
    if (const Opening* near = opening_near(openings, p, scene.part_below(p), scene.landmarks)) ++votes[near->name];
  const Opening* best = nullptr;
  for (const Opening& opening : openings)
    if (votes.count(opening.name) && (!best || votes[opening.name] > votes[best->name])) best = &opening;
  return best;
}

// An open garment, or why it is none.
std::string trimmed(const ClosedGarment& closed, const OpenScene& scene, const DensityTrimParams& params,
                    OpenGarment& garment) {
  if (closed.mesh.triangles.empty()) return "there is no closed surface";
  std::vector<BodyPart> parts;
  for (const Vector3d& v : closed.mesh.vertices) parts.push_back(scene.part_below(v));
  const std::vector<Opening> openings = garment_openings(closed.layout.kind, closed.mesh, parts, scene.landmarks);
  if (openings.empty()) return "the body lacks the limbs that a " + closed.layout.kind + " goes round";
  if (static_cast<int>(closed.support.points.size()) < params.neighbours)
    return "there are too few points to tell where they are thin";
  const TriangleNeighbours neighbours = triangle_neighbours(closed.mesh);
  const auto main_piece = [&](const std::vector<char>& kept) { return largest_piece(neighbours, kept); };
  const std::vector<char> kept = main_piece(kept_triangles(closed.mesh, neighbours, closed.support, params));
  garment.mesh = submesh(closed.mesh, with_single_fans(closed.mesh, neighbours, kept, main_piece));
  if (garment.mesh.triangles.empty()) return "no cloth is left";
  if (const std::string flaw = flaw_of(garment.mesh, static_cast<int>(openings.size())); !flaw.empty()) return flaw;
  std::set<std::string> named;
  for (const auto& loop : boundary_loops(garment.mesh)) {
    Rim rim;
    for (const int v : loop) rim.points.push_back(garment.mesh.vertices[v]);
    const Opening* opening = opening_of(rim.points, openings, scene);
    if (!opening || !named.insert(opening->name).second)
      return "two rims lie at the " + (opening ? opening->name : std::string("same place")) + "; expected one";
    rim.name = opening->name;
    garment.rims.push_back(std::move(rim));
  }
  garment.layout = with_sleeve_ends(closed.layout, garment.mesh, scene.landmarks);
  return {};
}

OpenGarments density_trim(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                          const Registration& registration, const Segmentation& segmentation,
                          const ClosedGarments& closed, const DensityTrimParams& params) {
  require_known(naked, "open.density_trim");
  const OpenScene scene{session, segmentation, naked.landmarks,
                        depth_views(session, calibration, registration.model_from_sensor), MeshQuery(naked.body)};
  OpenGarments opened;
  for (const auto& [name, garment] : closed.garments) {
    OpenGarment result;
    const std::string why = trimmed(garment, scene, params, result);
    if (why.empty())
      opened.garments.emplace(name, std::move(result));
    else
      opened.failed.emplace(name, why);
  }
  return opened;
}

const Open::Variant density_trim_variant{"density_trim", density_trim};

}  // namespace
}  // namespace dressform
