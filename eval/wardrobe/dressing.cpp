#include "eval/wardrobe/dressing.h"

#include <nlohmann/json.hpp>

#include "eval/metrics/fit_metrics.h"
#include "eval/metrics/girths.h"
#include "eval/metrics/intersections.h"
#include "eval/run/recorded_request.h"
#include "eval/wardrobe/layers.h"
#include "pipeline/correct/correct.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "scenes/scene.h"
#include "synthetic/body/body.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

template <class StageType>
const typename StageType::Entry& chosen_variant(const ReconstructionOptions& options) {
  const auto given = options.variants.find(StageType::name());
  return StageType::at(given == options.variants.end() ? StageType::default_variant() : given->second);
}

template <class StageType>
FieldValues chosen_values(const ReconstructionOptions& options) {
  const auto given = options.values.find(StageType::name());
  return given == options.values.end() ? FieldValues{} : given->second;
}

// A variant that a person's picks drive knows its two bodies alone.
template <class StageType>
void require_automatic(const ReconstructionOptions& options, const fs::path& run) {
  const auto& variant = chosen_variant<StageType>(options);
  if (!variant.picks.empty())
    throw InputError(run.string(), "was made with " + StageType::name() + "=" + variant.name +
                                       ", which takes points picked on its own user; expected a run whose " +
                                       StageType::name() + " needs none");
}

std::string name_of_path(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.filename().empty() ? normal.parent_path().filename().string() : normal.filename().string();
}

// The other garment where it is worn over this one.
const std::string* worn_over(const std::string& slot, const GarmentLayouts& layouts) {
  for (const auto& [other, layout] : layouts)
    if (other != slot && layout.worn == Worn::over) return &other;
  return nullptr;
}

void add_layer_scores(const KnownBody& body, Dressed& result) {
  for (const auto& [slot, garment] : result.garments) {
    const long pairs = metrics::intersecting_pairs(garment.mesh, body.body);
    result.scores.push_back({slot, "intersecting_pairs", "count", static_cast<double>(pairs)});
    result.intersecting_pairs += pairs;
    for (const auto& [other, beside] : result.garments) {
      if (other <= slot) continue;
      const long between = metrics::intersecting_pairs(garment.mesh, beside.mesh);
      result.scores.push_back({slot + "/" + other, "intersecting_pairs", "count", static_cast<double>(between)});
      result.intersecting_pairs += between;
    }
  }
}

void add_ease_scores(const CapturedClothes& clothes, const KnownBody& body, Dressed& result) {
  const auto naked = metrics::tape_levels(clothes.naked.body), user = metrics::tape_levels(body.body);
  using Level = metrics::TapeLevels::Level metrics::TapeLevels::*;
  const std::pair<const char*, Level> tapes[] = {{"chest", &metrics::TapeLevels::chest},
                                                 {"waist", &metrics::TapeLevels::waist},
                                                 {"hip", &metrics::TapeLevels::hip}};
  constexpr double kMillimetres = 1000;
  for (const auto& [slot, garment] : result.garments) {
    const Mesh& before = clothes.garments.garments.at(slot).mesh;
    for (const auto& [tape, level] : tapes) {
      if (!naked || !user) continue;
      const auto was = metrics::garment_girth_m(before, (*naked).*level);
      const auto is = metrics::garment_girth_m(garment.mesh, (*user).*level);
      if (!was || !is) continue;  // the garment does not go round the body there
      const double ease = kMillimetres * (*is - ((*user).*level).girth_m);
      const double meant = kMillimetres * (*was - ((*naked).*level).girth_m);
      result.scores.push_back({slot, std::string("ease_") + tape, "mm", ease});
      result.scores.push_back({slot, std::string("ease_") + tape + "_change", "mm", ease - meant});
    }
    result.scores.push_back({slot, "edge_stretch_p95", "1", metrics::edge_stretch_p95(before, garment.mesh)});
  }
}

}  // namespace

CapturedClothes captured_clothes(const fs::path& run, const StageProgress& progress) {
  const EndToEndRequest request = recorded_request(run);
  require_automatic<Fit>(request.options, run);
  require_automatic<Correct>(request.options, run);
  ArtifactStore store(request.store);
  const Reconstruction made =
      reconstruct(open_session(request.session, request.check_session), request.options, store, progress);
  CapturedClothes clothes;
  clothes.name = name_of_path(run);
  clothes.options = request.options;
  clothes.naked = {made.naked.get().body, made.landmarks.get()};
  if (made.user) clothes.user = KnownBody{made.user->get().body, made.user_landmarks->get()};
  clothes.garments = made.textured.get();
  for (const auto& [slot, garment] : made.opened.get().garments) clothes.layouts[slot] = garment.layout;
  if (clothes.garments.garments.empty())
    throw InputError(run.string(), "found no garment that came out of its pipeline; expected at least one");
  return clothes;
}

Customer customer_of(const fs::path& source, const MeshFrame& frame) {
  if (fs::is_directory(source)) {
    CapturedClothes run = captured_clothes(source);
    if (!run.user) throw InputError(source.string(), "is a run without a user's scan; expected one with a user");
    return {run.name, std::move(*run.user)};
  }
  if (source.extension() == ".toml") {
    const Scene scene = read_scene(source);
    return {scene.name, known_body(make_body(scene.user).mesh)};
  }
  const Mesh mesh = in_world(read_mesh(source), frame);
  if (!topology(mesh).closed())
    throw InputError(source.string(), "found holes, or sides of more than two triangles; expected a closed body");
  KnownBody body = known_body(mesh);
  if (!body.landmarks.has_trunk)
    throw InputError(source.string(),
                     "found no trunk between crotch and armpits; expected a standing body, metres, y up "
                     "(--unit and --up say otherwise)");
  return {source.stem().string(), std::move(body)};
}

Dressed dressed(const CapturedClothes& clothes, const KnownBody& body) {
  const auto& options = clothes.options;
  const FittedGarments fitted = chosen_variant<Fit>(options).run(clothes.naked, body, clothes.garments, clothes.layouts,
                                                                 chosen_values<Fit>(options), options.seed);
  const CorrectedGarments corrected =
      chosen_variant<Correct>(options).run(body, fitted, chosen_values<Correct>(options), options.seed);
  Dressed result;
  result.garments = corrected.garments;
  result.layouts = fitted.layouts;
  for (const auto& [slot, layout] : result.layouts) {
    const std::string* outer = worn_over(slot, result.layouts);
    if (!outer || !result.garments.count(slot) || !result.garments.count(*outer)) continue;
    TexturedMesh& over = result.garments.at(*outer);
    over.mesh = lifted_over(over.mesh, result.garments.at(slot).mesh, {});
  }
  add_layer_scores(body, result);
  add_ease_scores(clothes, body, result);
  return result;
}

}  // namespace dressform
