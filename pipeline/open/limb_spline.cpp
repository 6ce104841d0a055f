#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/geometry/sector.h"
#include "pipeline/open/cut.h"
#include "pipeline/open/depth_edges.h"
#include "pipeline/open/mask_edges.h"
#include "pipeline/open/open.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/rim_fit.h"

namespace dressform {
namespace {

struct LimbSplineParams {
  RimFitParams fit;
  MaskEdgeParams edges;
  DepthEdgeParams depth;
  double least_coverage = 0.2;
  double shortest_edge_m = 0.003;
};
template <class V>
void fields(V& v, LimbSplineParams& p) {
  v("knots", p.fit.knots, 12, 360, "", "knots of a rim's spline");
  v("smoothness", p.fit.smoothness, 1e-4, 100.0, "", "weight of a rim's second differences against the mask edges");
  v("flatness", p.fit.flatness, 0.0, 100.0, "", "weight of a rim's deviation from a flat cut through the limb");
  v("scale_m", p.fit.scale_m, 0.001, 0.1, "m", "scale of the robust weights");
  v("bend_price", p.fit.bend_price, 1.0, 1e4, "1/m", "price of a rim's kinks, in knots' worth of mask edges");
  v("rounds", p.fit.rounds, 1, 100, "", "rounds of reweighting");
  v("inside_px", p.edges.inside_px, 1, 50, "px", "the garment's label has to hold this far inside a mask edge");
  v("outside_px", p.edges.outside_px, 1, 50, "px", "other labels have to hold this far outside a mask edge");
  v("least_cosine", p.edges.least_cosine, 0.0, 0.9, "", "mask edges on surface seen at a lower n.v are outlines");
  v("in_front_m", p.edges.in_front_m, 0.005, 0.2, "m", "something this much nearer hides the rim");
  v("goes_on_m", p.edges.goes_on_m, 0.0, 0.2, "m", "the closed surface has to go on this far beyond a rim");
  v("least_rise", p.edges.least_rise, 0.0, 1.0, "", "part of the way out across a rim that has to lead along the limb");
  v("least_gap_m", p.depth.least_gap_m, 0.002, 0.1, "m", "cloth nearer to the skin is not told from it by depth");
  v("contradiction_m", p.depth.contradiction_m, 0.001, 1.0, "m",
    "mask edges this far from the same view's depth edges are dropped");
  v("least_coverage", p.least_coverage, 0.0, 1.0, "", "part of a rim that must be seen for it to count as observed");
  v("shortest_edge_m", p.shortest_edge_m, 0.0005, 0.02, "m", "shorter edges that the cut leaves are collapsed");
}

constexpr double kShortEnd = 0.05;      // weight of an end of the points that is short of the mask edges' curve
constexpr std::size_t kFewestEnds = 3;  // beside edges, to learn from
constexpr double kMostShort_m = 0.04;   // that points end short of the cloth
constexpr double kEarlyEnd_m = 0.015;   // points that end this much before the others of a rim were not seen further

struct Scene {
  const CaptureSession& session;
  const Segmentation& segmentation;
  std::vector<DepthView> views;
  MeshQuery naked;
  BodyLimbs limbs;
  bool tucked;  // the top is worn under the bottom
};

// Parts of the body under the vertices.
std::vector<BodyPart> parts_below(const Mesh& mesh, const Scene& scene) {
  std::vector<BodyPart> parts;
  for (const Vector3d& v : mesh.vertices) parts.push_back(scene.limbs.part_of(scene.naked.closest(v).triangle));
  return parts;
}

bool belongs(const Opening& opening, BodyPart part, const Vector3d& point, const BodyLimbs& limbs) {
  if (opening.name == "left_cuff") return part == BodyPart::left_arm;
  if (opening.name == "right_cuff") return part == BodyPart::right_arm;
  if (is_arm(part)) return false;
  if (opening.name == "left_ankle" || opening.name == "right_ankle") {
    const double side = (point - limbs.hips()).dot(limbs.left);
    return point.y() < limbs.crotch_y && (side > 0) == (opening.name == "left_ankle");
  }
  return true;
}

// Where the points that the surface was made from end, in the opening's coordinates: the farthest ones of each sector.
std::vector<RimSample> support_ends(const PointCloud& support, const Opening& opening, const Scene& scene) {
  constexpr int kSectors = 24;
  std::vector<std::vector<double>> sectors(kSectors);
  for (const Vector3d& p : support.points) {
    const BodyPart part = scene.limbs.part_of(scene.naked.closest(p).triangle);
    if (!belongs(opening, part, p, scene.limbs)) continue;
    sectors[sector_of(opening.angle(p), kSectors)].push_back(opening.along(p));
  }
  std::vector<RimSample> samples;
  std::vector<double> ends;
  for (int i = 0; i < kSectors; ++i) {
    auto& values = sectors[i];
    if (values.size() < 5) continue;
    std::nth_element(values.begin(), values.end() - 3, values.end());  // but for two strays
    samples.push_back({-M_PI + 2 * M_PI * (i + 0.5) / kSectors, *(values.end() - 3), 1});
    ends.push_back(samples.back().along);
  }
  if (ends.empty()) return samples;
  // Sectors that no view faces end early: they say nothing.
  std::nth_element(ends.begin(), ends.begin() + ends.size() * 2 / 3, ends.end());
  const double typical = ends[ends.size() * 2 / 3];
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                               [&](const RimSample& s) { return s.along < typical - kEarlyEnd_m; }),
                samples.end());
  return samples;
}

// The edges, and the ends of the points in sectors without edges. Points end short of the cloth, as pixels at edges are
// dropped: by how much is learned from the sectors that have both. Where too few do, ends short of `rough`, the curve
// of the edges alone, say little.
std::vector<RimSample> completed(std::vector<RimSample> edges, const RimCurve& rough, std::vector<RimSample> ends) {
  std::vector<double> short_by;
  const auto covered = [&edges](const RimSample& end) {
    return std::any_of(edges.begin(), edges.end(), [&](const RimSample& edge) {
      return std::abs(std::remainder(edge.angle - end.angle, 2 * M_PI)) < 0.15 &&
             std::abs(edge.along - end.along) < 0.1;
    });
  };
  std::vector<RimSample> alone;
  for (const RimSample& end : ends) {
    if (covered(end))
      short_by.push_back(rough.at(end.angle) - end.along);
    else
      alone.push_back(end);
  }
  const bool known = short_by.size() >= kFewestEnds;
  if (known) std::nth_element(short_by.begin(), short_by.begin() + short_by.size() / 2, short_by.end());
  for (RimSample& end : alone) {
    if (known)
      end.along += std::clamp(short_by[short_by.size() / 2], 0.0, kMostShort_m);
    else if (end.along < rough.at(end.angle))
      end.weight *= kShortEnd;
    edges.push_back(end);
  }
  return edges;
}

struct PlacedRim {
  RimCurve curve;
  bool observed = true;
};

// The rim from the mask edges; where too little of it was seen, from the ends of the points. A waist that the top hides
// goes round the body's waist, or as high as the surface reaches.
PlacedRim place_rim(const Opening& opening, const std::vector<RimSample>& edges, const ClosedGarment& closed,
                    const Scene& scene, const LimbSplineParams& params) {
  PlacedRim rim;
  rim.curve = fit_rim(edges, params.fit);
  const bool ankle = opening.name == "left_ankle" || opening.name == "right_ankle";
  if (rim.curve.coverage >= params.least_coverage) {
    if (ankle)
      rim.curve = fit_rim(completed(edges, rim.curve, support_ends(closed.support, opening, scene)), params.fit);
    return rim;
  }
  rim.observed = false;
  if (opening.name == "waist") {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vector3d& v : closed.mesh.vertices) highest = std::max(highest, v.y());
    const double height = std::min(scene.limbs.waist_y, highest - 0.02);
    rim.curve.knots.assign(params.fit.knots, height - opening.centre.y());
    return rim;
  }
  rim.curve = fit_rim(support_ends(closed.support, opening, scene), params.fit);
  return rim;
}

// How much nearer each vertex is to the chosen triangles of the body than to the rest, halved.
std::vector<double> nearer_to(const std::vector<char>& chosen, const Mesh& mesh, const Scene& scene) {
  Mesh own{scene.naked.mesh().vertices, {}}, rest = own;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    (chosen[i] ? own : rest).triangles.push_back(scene.naked.mesh().triangles[i]);
  const MeshQuery to_own(compacted(own)), to_rest(compacted(rest));
  std::vector<double> result(mesh.vertices.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = (to_rest.closest(mesh.vertices[i]).distance - to_own.closest(mesh.vertices[i]).distance) / 2;
  return result;
}

bool is_cuff(const Opening& opening) { return opening.name == "left_cuff" || opening.name == "right_cuff"; }
BodyPart arm_of(const Opening& cuff) { return cuff.name == "left_cuff" ? BodyPart::left_arm : BodyPart::right_arm; }

// Beyond a cuff, only what is nearer to the arm comes off, also where the sleeve touches the trunk.
std::vector<double> limit_of(const Opening& opening, const Mesh& mesh, const Scene& scene) {
  if (!is_cuff(opening)) return std::vector<double>(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<char> arm(scene.limbs.triangle_parts.size());
  for (std::size_t i = 0; i < arm.size(); ++i) arm[i] = scene.limbs.triangle_parts[i] == arm_of(opening);
  return nearer_to(arm, mesh, scene);
}

// Beyond a hem, nothing that is nearest to what the sleeves cover of the arms: where a sleeve touches the trunk it
// would come off with what the hem closes, because it hangs as low.
std::vector<double> limit_of_hem(const std::vector<Opening>& openings, const std::vector<RimCurve>& curves,
                                 const Mesh& mesh, const Scene& scene) {
  std::vector<char> bare(scene.limbs.triangle_parts.size(), 1);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (!is_cuff(openings[k])) continue;
    for (std::size_t i = 0; i < bare.size(); ++i) {
      if (scene.limbs.triangle_parts[i] != arm_of(openings[k])) continue;
      const Vector3d& corner = scene.naked.mesh().vertices[scene.naked.mesh().triangles[i][0]];
      if (openings[k].along(corner) < curves[k].at(openings[k].angle(corner))) bare[i] = 0;
    }
  }
  if (std::find(bare.begin(), bare.end(), 0) == bare.end())
    return std::vector<double>(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  return nearer_to(bare, mesh, scene);
}

// The pole, a vertex in the middle of what lies beyond the rim: the farthest along among those over the right part of
// the body; of an arm, not where it touches the trunk.
Cap make_cap(const Opening& opening, const RimCurve& curve, const Mesh& mesh, const std::vector<BodyPart>& parts,
             const std::vector<double>& limit, const BodyLimbs& limbs) {
  Cap cap;
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d& v = mesh.vertices[i];
    const double along = opening.along(v);
    cap.beyond.push_back(std::min(along - curve.at(opening.angle(v)), limit[i]));
    const double far = std::isfinite(limit[i]) ? cap.beyond.back() : along;
    if (!belongs(opening, parts[i], v, limbs) || far <= farthest) continue;
    farthest = far;
    cap.pole = static_cast<int>(i);
  }
  return cap;
}

// All that is known of a garment before its rims are fitted.
struct Work {
  std::string kind;
  std::vector<Opening> openings;
  std::map<std::string, std::vector<RimSample>> edges;
  std::vector<BodyPart> parts;                       // below the vertices
  std::map<std::string, std::vector<double>> limit;  // limit_of every opening
};

// The loops of the open mesh, each named after the opening whose cut is nearest.
std::vector<Rim> named_rims(const Mesh& mesh, const CutResult& cut, const std::vector<Opening>& openings,
                            const std::vector<bool>& observed) {
  std::vector<Vector3d> centres(openings.size(), Vector3d::Zero());
  std::vector<int> counts(openings.size(), 0);
  for (std::size_t i = 0; i < cut.mesh.vertices.size(); ++i) {
    if (cut.cap_of_vertex[i] < 0) continue;
    centres[cut.cap_of_vertex[i]] += cut.mesh.vertices[i];
    ++counts[cut.cap_of_vertex[i]];
  }
  std::vector<Rim> rims;
  for (const auto& loop : boundary_loops(mesh)) {
    Vector3d centre = Vector3d::Zero();
    for (const int v : loop) centre += mesh.vertices[v] / loop.size();
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < openings.size(); ++k) {
      const double distance = (centres[k] / std::max(1, counts[k]) - centre).norm();
      if (distance < nearest) best = k;
      nearest = std::min(nearest, distance);
    }
    Rim rim{openings[best].name, {}, observed[best]};
    for (const int v : loop) rim.points.push_back(mesh.vertices[v]);
    rims.push_back(std::move(rim));
  }
  return rims;
}

// Cuts at rims of the given stiffness; absent when that does not give one piece with one loop for each opening.
std::optional<OpenGarment> cut_open(const ClosedGarment& closed, const Work& work, const Scene& scene,
                                    const LimbSplineParams& params) {
  std::vector<Cap> caps;
  std::vector<bool> observed;
  std::vector<RimCurve> curves;
  for (const Opening& opening : work.openings) {
    const auto samples = work.edges.find(opening.name);
    const PlacedRim rim = place_rim(opening, samples == work.edges.end() ? std::vector<RimSample>{} : samples->second,
                                    closed, scene, params);
    if (rim.curve.knots.empty()) return {};
    const bool below_sleeves = opening.name == "hem" && (work.kind == "shirt" || work.kind == "dress");
    const std::vector<double> limit =
        below_sleeves ? limit_of_hem(work.openings, curves, closed.mesh, scene) : work.limit.at(opening.name);
    caps.push_back(make_cap(opening, rim.curve, closed.mesh, work.parts, limit, scene.limbs));
    curves.push_back(rim.curve);
    observed.push_back(rim.observed && !(opening.name == "hem" && work.kind == "shirt" && scene.tucked));
  }
  const CutResult cut = cut_caps(closed.mesh, caps);
  if (cut.mesh.triangles.empty()) return {};
  OpenGarment garment;
  garment.mesh = without_slivers(cut.mesh, params.shortest_edge_m);
  const Topology t = topology(garment.mesh);
  const int loops = static_cast<int>(work.openings.size());
  if (t.loops != loops || t.components != 1 || t.non_manifold_edges || t.euler() != 2 - loops) return {};
  garment.rims = named_rims(garment.mesh, cut, work.openings, observed);
  return garment;
}

// The kind that the surface was made as: it decides how many openings can be cut.
std::string kind_of(const std::string& name, const Mesh& closed, const Scene& scene) {
  const auto found = scene.segmentation.kinds.find(name);
  const std::string kind = found != scene.segmentation.kinds.end() ? found->second : name == "top" ? "shirt" : "skirt";
  return kind == "trousers" || kind == "skirt" ? closed_bottom_kind(closed, scene.limbs, kind) : kind;
}

// The garment worn over this one, where they meet.
std::optional<Label> worn_over(Label label, const Scene& scene) {
  if (label == Label::bottom && !scene.tucked) return Label::top;
  return {};
}

std::optional<OpenGarment> open_garment(const std::string& name, const ClosedGarment& closed, const Scene& scene,
                                        LimbSplineParams params) {
  if (closed.mesh.triangles.empty()) return {};
  Work work;
  work.kind = kind_of(name, closed.mesh, scene);
  work.parts = parts_below(closed.mesh, scene);
  work.openings = garment_openings(work.kind, closed.mesh, work.parts, scene.limbs);
  if (work.openings.empty()) return {};
  const Label label = name == "top" ? Label::top : Label::bottom;
  const MeshQuery query(closed.mesh);
  work.edges = rim_samples(scene.segmentation, label, worn_over(label, scene), scene.session, scene.views, query,
                           scene.naked, scene.limbs, work.openings, params.edges);
  for (auto& [opening, samples] : depth_rim_samples(scene.segmentation, label, scene.session, scene.views, query,
                                                    scene.naked, scene.limbs, work.openings, params.depth)) {
    auto& edges = work.edges[opening];
    edges = reconciled(edges, samples, params.depth.contradiction_m);
  }
  for (const Opening& opening : work.openings) work.limit[opening.name] = limit_of(opening, closed.mesh, scene);
  for (int attempt = 0; attempt < 4; ++attempt, params.fit.smoothness *= 20) {  // stiffer, should the soft rims cross
    auto garment = cut_open(closed, work, scene, params);
    if (garment) return garment;
  }
  return {};
}

// Rims as periodic splines in the coordinates of the limbs, fitted robustly to where the masks end on the closed
// surface; the surface is cut exactly there. The naked body's limbs say which openings there are.
OpenGarments limb_spline(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                         const Registration& registration, const Segmentation& segmentation,
                         const ClosedGarments& closed, const LimbSplineParams& params) {
  const Scene scene{session,
                    segmentation,
                    depth_views(session, calibration, registration),
                    MeshQuery(naked.body),
                    find_limbs(naked.body, front_from_prior(session, registration)),
                    closed.tucked};
  OpenGarments opened;
  for (const auto& [name, garment] : closed.garments) {
    auto open = open_garment(name, garment, scene, params);
    if (open) opened.garments.emplace(name, std::move(*open));
  }
  return opened;
}

const Open::Variant limb_spline_variant{"limb_spline", limb_spline};

}  // namespace
}  // namespace dressform
