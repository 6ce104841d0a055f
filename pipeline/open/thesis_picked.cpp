// The thesis's openings (section 3.4.2): cut along points that a person picked on the closed surface, and stitched to
// them, so that the rims run through the points themselves. As tables 14 and 15 have it, a garment of V vertices, F
// faces and Euler characteristic chi then has B = 2V - F - 2 chi boundary edges: as many as points were picked.
#include <algorithm>
#include <optional>
#include <utility>

#include "pipeline/garment/garment_kind.h"
#include "pipeline/garment/sleeves.h"
#include "pipeline/open/flaw.h"
#include "pipeline/open/open.h"
#include "pipeline/open/picked_cut.h"
#include "pipeline/open/picked_loop.h"
#include "pipeline/open/stitch.h"
#include "scenes/picks.h"

namespace dressform {
namespace {

struct ThesisPickedParams {
  PickedCutParams cut;
};
template <class V>
void fields(V& v, ThesisPickedParams& p) {
  v("color_m", p.cut.color_m, 0.001, 0.1, "m", "farthest point of the cloud that gives surface its rough colour");
  v("narrowest", p.cut.narrowest, 0.3, 10.0, "", "mean edges from a path within which triangles are deleted at first");
  v("widest_m", p.cut.widest_m, 0.001, 0.1, "m", "the same at most, where that does not part the surface");
  v("farthest_m", p.cut.farthest_m, 0.005, 0.5, "m", "picked points further off the surface are of something else");
}

std::vector<std::string> rim_names(const std::string& kind) {
  if (kind == "trousers") return {"waist", "left_ankle", "right_ankle"};
  if (kind == "skirt") return {"waist", "hem"};
  return {"neck", "left_cuff", "right_cuff", "hem"};
}

using Loops = std::map<std::string, std::vector<Vector3d>>;

Loops picked_rims(const std::string& garment, const Picks& picks) {
  const std::string prefix = "rim_" + garment + "_";
  Loops loops;
  for (const auto& [name, parts] : picks.points)
    if (name.rfind(prefix, 0) == 0) loops[name.substr(prefix.size())] = picked_loop(parts);
  return loops;
}

// Whoever picks sees whether there are legs; the surface's own kind where the points leave that open.
std::string kind_by(const Loops& loops, const GarmentLayout& layout) {
  if (layout.upper()) return layout.kind;
  const bool ankles = loops.count("left_ankle") || loops.count("right_ankle"), hem = loops.count("hem");
  return ankles == hem ? layout.kind : hem ? "skirt" : "trousers";
}

// What is missing from the picks of a garment of this kind, file by file, and how it is made; empty where nothing is.
std::string missing(const std::string& garment, const std::string& kind, const Loops& loops) {
  std::string files;
  for (const auto& name : rim_names(kind))
    if (const auto loop = loops.find(name); loop == loops.end() || loop->second.size() < 3)
      files += (files.empty() ? "" : ", ") + ("picks/model/rim_" + garment + "_" + name) +
               (loop == loops.end() ? "" : " (fewer than three points in a frame whose pose is known)");
  if (files.empty()) return {};
  return "the points round the rims of this " + kind + " lack " + files +
         "; expected a list for each, in order all round the rim: pick it on the run's " + garment +
         "_closed.ply with MeshLab (PickPoints), and save it as .pp under that name (scenes/README.md, \"Picks\")";
}

// A rim beneath the other garment is where that one ends, not where the cloth does.
bool observed(const std::string& rim, const GarmentLayout& layout) {
  return !(layout.worn == Worn::under && rim == (layout.upper() ? "hem" : "waist"));
}

// The garment, or why there is none.
std::optional<OpenGarment> opened(const std::string& name, const ClosedGarment& closed, const Landmarks& limbs,
                                  const Picks& picks, const PickedCutParams& params, std::string& why) {
  if (closed.mesh.triangles.empty() || !topology(closed.mesh).closed()) why = "there is no closed surface";
  if (!why.empty()) return {};
  const Loops loops = picked_rims(name, picks);
  const std::string kind = kind_by(loops, closed.layout);
  if (!(why = missing(name, kind, loops)).empty()) return {};
  std::vector<PickedRim> rims;
  for (const auto& rim : rim_names(kind)) rims.push_back({rim, loops.at(rim)});
  PickedCut cut = cut_along(closed, rims, params);
  if (!(why = cut.why).empty()) return {};

  OpenGarment garment;
  garment.mesh = std::move(cut.mesh);
  garment.layout = with_kind(closed.layout, {kind, closed.layout.sure_kind}, limbs);
  for (std::size_t i = 0; i < rims.size(); ++i) {
    stitch(garment.mesh, cut.boundaries[i], rims[i].points);
    garment.rims.push_back({rims[i].name, rims[i].points, observed(rims[i].name, garment.layout), {}});
  }
  garment.mesh = compacted(garment.mesh);
  if (!(why = flaw_of(garment.mesh, static_cast<int>(rims.size()))).empty()) return {};
  garment.layout = with_sleeve_ends(garment.layout, garment.mesh, limbs);
  return garment;
}

OpenGarments thesis_picked(const CaptureSession&, const Calibration&, const KnownBody& naked, const Registration&,
                           const Segmentation&, const ClosedGarments& closed, const ThesisPickedParams& params,
                           const Picks& picks) {
  require_known(naked, "open.thesis_picked");
  OpenGarments result;
  for (const auto& [name, garment] : closed.garments) {
    std::string why;
    if (auto made = opened(name, garment, naked.landmarks, picks, params.cut, why))
      result.garments.emplace(name, std::move(*made));
    else
      result.failed.emplace(name, why);
  }
  return result;
}

const Open::Variant thesis_picked_variant{"thesis_picked", thesis_picked, {"rim_*"}};

}  // namespace
}  // namespace dressform
