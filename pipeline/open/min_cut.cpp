// Garment and caps told apart on the closed surface by a minimum cut: what the views see of every place and how far it
// is from the points, against the length of the rims. Boykov and Kolmogorov, PAMI 2004 (OpenCV's); on meshes as in
// Katz and Tal, SIGGRAPH 2003.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <string>

#include "pipeline/garment/sleeves.h"
#include "pipeline/open/cut.h"
#include "pipeline/open/flaw.h"
#include "pipeline/open/named_rims.h"
#include "pipeline/open/open_scene.h"
#include "pipeline/open/place_votes.h"
#include "pipeline/open/support_distance.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

constexpr double kThird = 1.0 / 3;  // of a triangle's area belongs to each corner
constexpr double kFarEnough = 2;    // times unsupported_m off the points: as far as counts
constexpr double kSideways = 0.25;  // of the support's weight on cloth that does not close an opening: under arms and
                                    // between legs no view sees cloth, and its lack says little
constexpr double kDualOfEdge = 0.57735;  // of a side: length between the middles of two even triangles that share it

struct MinCutParams {
  double unsupported_m = 0.012;
  double support_weight = 0.5;
  double smoothness_m = 0.03;
  double in_front_m = 0.03;
  double least_cosine = 0.2;
  int smooth_rounds = 5;
  double shortest_edge_m = 0.003;
  double least_coverage = 0.5;
};
template <class V>
void fields(V& v, MinCutParams& p) {
  v("unsupported_m", p.unsupported_m, 0.002, 0.1, "m", "places farther from all points than this speak for a cap");
  v("support_weight", p.support_weight, 0.0, 10.0, "", "of the distance from the points, in votes of one view");
  v("smoothness_m", p.smoothness_m, 0.0, 1.0, "m", "price of a metre of rim, in square metres against one view's vote");
  v("in_front_m", p.in_front_m, 0.005, 0.2, "m", "something this much nearer hides a place from a view");
  v("least_cosine", p.least_cosine, 0.0, 0.9, "", "places seen at a lower n.v have no vote");
  v("smooth_rounds", p.smooth_rounds, 0, 100, "", "of averaging the cut's labels, which rounds its corners off");
  v("shortest_edge_m", p.shortest_edge_m, 0.0005, 0.02, "m", "shorter edges that the cut leaves are collapsed");
  v("least_coverage", p.least_coverage, 0.0, 1.0, "",
    "part of a rim beyond which a view must see for it to be observed");
}

struct MeshSide {
  int a, b;
  double length_m;
};
std::vector<MeshSide> sides_of(const Mesh& mesh) {
  std::vector<MeshSide> sides;
  for (const Vector3i& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (const int a = t[k], b = t[(k + 1) % 3]; a < b)  // closed: every side once each way
        sides.push_back({a, b, (mesh.vertices[a] - mesh.vertices[b]).norm()});
  return sides;
}

std::vector<double> corner_areas_m2(const Mesh& mesh) {
  std::vector<double> areas(mesh.vertices.size(), 0);
  for (const Vector3i& t : mesh.triangles) {
    const double third_m2 = kThird * triangle_area_m2(mesh, t);
    for (const int v : t) areas[v] += third_m2;
  }
  return areas;
}

// Per vertex, votes for a cap less those for the garment. Caps lie across their openings.
std::vector<double> cap_votes(const ClosedGarment& closed, const std::vector<Opening>& openings, const PlaceVotes& seen,
                              const MinCutParams& params) {
  const std::vector<double> far = support_distances(closed.mesh.vertices, closed.support.points, 1);
  const std::vector<Vector3d> normals = vertex_normals(closed.mesh);
  std::vector<double> votes(far.size());
  for (std::size_t v = 0; v < votes.size(); ++v) {
    const double lack = std::min(far[v] / params.unsupported_m, kFarEnough) - 1;
    double across = 0;
    for (const Opening& opening : openings) across = std::max(across, opening.axis.dot(normals[v]));
    const double trust = kSideways + (1 - kSideways) * across;
    votes[v] = seen.elsewhere[v] - seen.garment[v] + params.support_weight * trust * lack;
  }
  return votes;
}

// 1 on caps, -1 on the garment, rounded off by averages over neighbours.
std::vector<double> cut_field(const Mesh& mesh, const std::vector<double>& votes, const MinCutParams& params) {
  const std::vector<MeshSide> sides = sides_of(mesh);
  const std::vector<double> areas = corner_areas_m2(mesh);
  cv::detail::GCGraph<double> graph(static_cast<unsigned>(votes.size()), static_cast<unsigned>(2 * sides.size()));
  for (std::size_t v = 0; v < votes.size(); ++v) {
    const int vertex = graph.addVtx();
    const double cost = areas[v] * votes[v];
    graph.addTermWeights(vertex, std::max(0.0, cost), std::max(0.0, -cost));
  }
  for (const MeshSide& side : sides) {
    const double price = params.smoothness_m * kDualOfEdge * side.length_m;
    graph.addEdges(side.a, side.b, price, price);
  }
  graph.maxFlow();
  std::vector<double> field(votes.size());
  for (std::size_t v = 0; v < field.size(); ++v) field[v] = graph.inSourceSegment(static_cast<int>(v)) ? 1 : -1;
  for (int round = 0; round < params.smooth_rounds; ++round) {
    std::vector<double> sums(field), counts(field.size(), 1);
    for (const MeshSide& side : sides) {
      sums[side.a] += field[side.b];
      sums[side.b] += field[side.a];
      ++counts[side.a];
      ++counts[side.b];
    }
    for (std::size_t v = 0; v < field.size(); ++v) field[v] = sums[v] / counts[v];
  }
  return field;
}

// The vertex farthest out of an opening, of those on its part of the body that the cut took for a cap; -1 for none.
int pole_of(const Opening& opening, const Mesh& mesh, const std::vector<BodyPart>& parts,
            const std::vector<double>& field, const Landmarks& landmarks) {
  double farthest = -std::numeric_limits<double>::infinity();
  int pole = -1;
  for (std::size_t v = 0; v < field.size(); ++v) {
    const double along = opening.along(mesh.vertices[v]);
    if (field[v] <= 0 || along <= farthest || !belongs(opening, parts[v], mesh.vertices[v], landmarks)) continue;
    farthest = along;
    pole = static_cast<int>(v);
  }
  return pole;
}

// Part of a rim near which some view sees that the cloth has ended.
bool rim_seen(const std::vector<Vector3d>& rim, const Mesh& closed, const PlaceVotes& seen, double least_coverage) {
  constexpr double kBeside_m = 0.02;  // from the rim to the seen place beyond it
  std::vector<Vector3d> places;
  for (std::size_t v = 0; v < closed.vertices.size(); ++v)
    if (seen.elsewhere[v] > 0) places.push_back(closed.vertices[v]);
  int near = 0;
  for (const double distance : support_distances(rim, places, 1)) near += distance < kBeside_m;
  return near >= least_coverage * static_cast<double>(rim.size());
}

// An open garment, or why it is none.
std::string parted(const std::string& name, const ClosedGarment& closed, const OpenScene& scene,
                   const MinCutParams& params, OpenGarment& garment) {
  const Mesh& mesh = closed.mesh;
  if (mesh.triangles.empty()) return "there is no closed surface";
  std::vector<BodyPart> parts;
  for (const Vector3d& v : mesh.vertices) parts.push_back(scene.part_below(v));
  const std::vector<Opening> openings = garment_openings(closed.layout.kind, mesh, parts, scene.landmarks);
  if (openings.empty()) return "the body lacks the limbs that a " + closed.layout.kind + " goes round";
  const Label label = name == "top" ? Label::top : Label::bottom;
  const PlaceVotes seen =
      place_votes(mesh, label, closed.layout.worn == Worn::under, scene, params.in_front_m, params.least_cosine);
  const std::vector<double> field = cut_field(mesh, cap_votes(closed, openings, seen, params), params);
  std::vector<Cap> caps;
  for (const Opening& opening : openings) {
    caps.push_back({field, pole_of(opening, mesh, parts, field, scene.landmarks)});
    if (caps.back().pole < 0) return "neither views nor points show that the cloth ends at the " + opening.name;
  }
  const CutResult cut = cut_caps(mesh, caps);
  if (cut.mesh.triangles.empty()) return "the rims do not part the surface";
  garment.mesh = without_slivers(cut.mesh, params.shortest_edge_m);
  if (const std::string flaw = flaw_of(garment.mesh, static_cast<int>(openings.size())); !flaw.empty()) return flaw;
  garment.rims = named_rims(garment.mesh, cut, openings, std::vector<bool>(openings.size(), true));
  for (Rim& rim : garment.rims) rim.observed = rim_seen(rim.points, mesh, seen, params.least_coverage);
  garment.layout = with_sleeve_ends(closed.layout, garment.mesh, scene.landmarks);
  return {};
}

OpenGarments min_cut(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                     const Registration& registration, const Segmentation& segmentation, const ClosedGarments& closed,
                     const MinCutParams& params) {
  require_known(naked, "open.min_cut");
  const OpenScene scene{session, segmentation, naked.landmarks,
                        depth_views(session, calibration, registration.model_from_sensor), MeshQuery(naked.body)};
  OpenGarments opened;
  for (const auto& [name, garment] : closed.garments) {
    OpenGarment result;
    const std::string why = parted(name, garment, scene, params, result);
    if (why.empty())
      opened.garments.emplace(name, std::move(result));
    else
      opened.failed.emplace(name, why);
  }
  return opened;
}

const Open::Variant min_cut_variant{"min_cut", min_cut};

}  // namespace
}  // namespace dressform
