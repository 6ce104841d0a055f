// Rims as periodic splines in the coordinates of the limbs, the surface cut exactly there.
#include "pipeline/garment/sleeves.h"
#include "pipeline/open/caps.h"
#include "pipeline/open/cut.h"
#include "pipeline/open/depth_edges.h"
#include "pipeline/open/flaw.h"
#include "pipeline/open/mask_edges.h"
#include "pipeline/open/named_rims.h"
#include "pipeline/open/open.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/place_rim.h"

namespace dressform {
namespace {

struct LimbSplineParams {
  PlaceRimParams rim;
  MaskEdgeParams edges;
  DepthEdgeParams depth;
  double shortest_edge_m = 0.003;
  int attempts = 4;
  double stiffer = 20;
};
template <class V>
void fields(V& v, LimbSplineParams& p) {
  v("knots", p.rim.fit.knots, 12, 360, "", "knots of a rim's spline");
  v("smoothness", p.rim.fit.smoothness, 1e-4, 100.0, "", "weight of a rim's second differences against the mask edges");
  v("flatness", p.rim.fit.flatness, 0.0, 100.0, "", "weight of a rim's deviation from a flat cut through the limb");
  v("scale_m", p.rim.fit.scale_m, 0.001, 0.1, "m", "scale of the robust weights");
  v("bend_price", p.rim.fit.bend_price, 1.0, 1e4, "1/m", "price of a rim's kinks, in knots' worth of mask edges");
  v("rounds", p.rim.fit.rounds, 1, 100, "", "rounds of reweighting");
  v("inside_px", p.edges.inside_px, 1, 50, "px", "the garment's label has to hold this far inside a mask edge");
  v("outside_px", p.edges.outside_px, 1, 50, "px", "other labels have to hold this far outside a mask edge");
  v("least_cosine", p.edges.least_cosine, 0.0, 0.9, "", "mask edges on surface seen at a lower n.v are outlines");
  v("in_front_m", p.edges.in_front_m, 0.005, 0.2, "m", "something this much nearer hides the rim");
  v("goes_on_m", p.edges.goes_on_m, 0.0, 0.2, "m", "the closed surface has to go on this far beyond a rim");
  v("least_rise", p.edges.least_rise, 0.0, 1.0, "", "part of the way out across a rim that has to lead along the limb");
  v("least_gap_m", p.depth.least_gap_m, 0.002, 0.1, "m", "cloth nearer to the skin is not told from it by depth");
  v("contradiction_m", p.depth.contradiction_m, 0.001, 1.0, "m",
    "mask edges this far from the same view's depth edges are dropped");
  v("least_coverage", p.rim.least_coverage, 0.0, 1.0, "",
    "part of a rim that must be seen for it to count as observed");
  v("shortest_edge_m", p.shortest_edge_m, 0.0005, 0.02, "m", "shorter edges that the cut leaves are collapsed");
  v("attempts", p.attempts, 1, 20, "", "cuts of a garment, each at stiffer rims, should soft ones cross");
  v("stiffer", p.stiffer, 1.0, 1000.0, "", "times smoother from one attempt to the next");
}

// All that is known of a garment before its rims are fitted.
struct Work {
  const ClosedGarment& closed;
  std::vector<Opening> openings;
  std::map<std::string, std::vector<RimSample>> edges;
  std::vector<BodyPart> parts;                       // of the body below the vertices
  std::map<std::string, std::vector<double>> limit;  // limit_of every opening
};

// A garment cut open, or why it is not.
struct CutOutcome {
  std::optional<OpenGarment> garment;
  std::string why;
};

// A shirt's hem that is tucked in shows nowhere: what was fitted is the waistband over it.
bool may_be_observed(const Opening& opening, const GarmentLayout& layout) {
  return !(opening.name == "hem" && layout.kind == "shirt" && layout.worn == Worn::under);
}

// Cuts at rims of the given stiffness.
CutOutcome cut_open(const Work& work, const OpenScene& scene, const LimbSplineParams& params) {
  const Mesh& mesh = work.closed.mesh;
  std::vector<Cap> caps;
  std::vector<bool> observed;
  std::vector<RimCurve> curves;
  for (const Opening& opening : work.openings) {
    const auto samples = work.edges.find(opening.name);
    const PlacedRim rim = place_rim(opening, samples == work.edges.end() ? std::vector<RimSample>{} : samples->second,
                                    work.closed, scene, params.rim);
    if (rim.curve.knots.empty()) return {{}, "neither edges nor points show where the " + opening.name + " is"};
    const bool below_sleeves = opening.name == "hem" && work.closed.layout.upper();
    const std::vector<double> limit =
        below_sleeves ? limit_of_hem(work.openings, curves, mesh, scene) : work.limit.at(opening.name);
    caps.push_back(make_cap(opening, rim.curve, mesh, work.parts, limit, scene.landmarks));
    curves.push_back(rim.curve);
    observed.push_back(rim.observed && may_be_observed(opening, work.closed.layout));
  }
  const CutResult cut = cut_caps(mesh, caps);
  if (cut.mesh.triangles.empty()) return {{}, "the rims do not part the surface"};
  OpenGarment garment;
  garment.mesh = without_slivers(cut.mesh, params.shortest_edge_m);
  if (const std::string flaw = flaw_of(garment.mesh, static_cast<int>(work.openings.size())); !flaw.empty())
    return {{}, flaw};
  garment.rims = named_rims(garment.mesh, cut, work.openings, observed, curves);
  garment.layout = with_sleeve_ends(work.closed.layout, garment.mesh, scene.landmarks);
  return {std::move(garment), {}};
}

// The garment worn over this one, where they meet.
std::optional<Label> worn_over(Label label, const GarmentLayout& layout) {
  if (label == Label::bottom && layout.worn != Worn::over) return Label::top;
  return {};
}

Work prepare(const std::string& name, const ClosedGarment& closed, const OpenScene& scene,
             const LimbSplineParams& params) {
  Work work{closed, {}, {}, {}, {}};
  for (const Vector3d& v : closed.mesh.vertices) work.parts.push_back(scene.part_below(v));
  work.openings = garment_openings(closed.layout.kind, closed.mesh, work.parts, scene.landmarks);
  if (work.openings.empty()) return work;
  const Label label = name == "top" ? Label::top : Label::bottom;
  const MeshQuery query(closed.mesh);
  work.edges = rim_samples(scene.segmentation, label, worn_over(label, closed.layout), scene.session, scene.views,
                           query, scene.naked, scene.landmarks, work.openings, params.edges);
  for (auto& [opening, samples] : depth_rim_samples(scene.segmentation, label, scene.session, scene.views, query,
                                                    scene.naked, scene.landmarks, work.openings, params.depth)) {
    auto& edges = work.edges[opening];
    edges = reconciled(edges, samples, params.depth.contradiction_m);
  }
  for (const Opening& opening : work.openings) work.limit[opening.name] = limit_of(opening, closed.mesh, scene);
  return work;
}

CutOutcome open_garment(const std::string& name, const ClosedGarment& closed, const OpenScene& scene,
                        LimbSplineParams params) {
  if (closed.mesh.triangles.empty()) return {{}, "there is no closed surface"};
  const Work work = prepare(name, closed, scene, params);
  if (work.openings.empty()) return {{}, "the body lacks the limbs that a " + closed.layout.kind + " goes round"};
  CutOutcome outcome;
  for (int attempt = 0; attempt < params.attempts && !outcome.garment; ++attempt) {
    outcome = cut_open(work, scene, params);
    params.rim.fit.smoothness *= params.stiffer;
  }
  return outcome;
}

// Rims as periodic splines in the coordinates of the limbs, fitted robustly to where the masks end on the closed
// surface; the surface is cut exactly there. The garment's layout says which openings there are.
OpenGarments limb_spline(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                         const Registration& registration, const Segmentation& segmentation,
                         const ClosedGarments& closed, const LimbSplineParams& params) {
  require_known(naked, "open.limb_spline");
  const OpenScene scene{session, segmentation, naked.landmarks,
                        depth_views(session, calibration, registration.model_from_sensor), MeshQuery(naked.body)};
  OpenGarments opened;
  for (const auto& [name, garment] : closed.garments) {
    CutOutcome outcome = open_garment(name, garment, scene, params);
    if (outcome.garment)
      opened.garments.emplace(name, std::move(*outcome.garment));
    else
      opened.failed.emplace(name, outcome.why);
  }
  return opened;
}

const Open::Variant limb_spline_variant{"limb_spline", limb_spline};

}  // namespace
}  // namespace dressform
