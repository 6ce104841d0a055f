#include "eval/evaluate_parts.h"
#include "eval/metrics/fit_metrics.h"
#include "eval/metrics/girths.h"
#include "eval/metrics/intersections.h"

namespace dressform::evaluation {
using namespace metrics;

namespace {

struct TapeName {
  const char* name;
  TapeLevels::Level TapeLevels::*level;
};
const TapeName kTapes[] = {{"chest", &TapeLevels::chest}, {"waist", &TapeLevels::waist}, {"hip", &TapeLevels::hip}};

const GarmentOutput* fitted_of(const RunOutputs& outputs, const std::string& slot) {
  const auto found = outputs.garments.find(slot);
  return found == outputs.garments.end() || found->second.fitted.triangles.empty() ? nullptr : &found->second;
}

std::optional<TapeLevels> levels_of(const Mesh& body) {
  if (body.triangles.empty()) return {};
  return tape_levels(body);
}

void add_ease(StageRows& rows, const std::string& slot, const GarmentOutput* garment,
              const std::optional<TapeLevels>& naked, const std::optional<TapeLevels>& user) {
  for (const auto& tape : kTapes) {
    const std::string metric = slot + "/ease_" + tape.name;
    if (!garment || !naked || !user) {
      for (const char* end : {"_mm@3", "_fitted_mm@3", "_change_mm@3"}) rows.fail(metric + end, "mm");
      continue;
    }
    const auto before = garment_girth_m(garment->mesh, (*naked).*tape.level);
    const auto after = garment_girth_m(garment->fitted, (*user).*tape.level);
    if (!before || !after) {  // the garment does not go round the body there
      for (const char* end : {"_mm@3", "_fitted_mm@3", "_change_mm@3"}) rows.absent(metric + end, "mm");
      continue;
    }
    const double ease = (*before - ((*naked).*tape.level).girth_m) * 1000;
    const double fitted = (*after - ((*user).*tape.level).girth_m) * 1000;
    rows.add(metric + "_mm@3", "mm", ease);
    rows.add(metric + "_fitted_mm@3", "mm", fitted);
    rows.add(metric + "_change_mm@3", "mm", fitted - ease);
  }
}

void add_girths(StageRows& rows, const std::string& body, const std::optional<TapeLevels>& levels,
                const std::optional<TapeLevels>& truth) {
  for (const auto& tape : kTapes) {
    const std::string metric = body + "/girth_" + tape.name + "_error_mm@2";
    if (!truth)
      rows.absent(metric, "mm");
    else if (!levels)
      rows.fail(metric, "mm");
    else
      rows.add(metric, "mm", (((*levels).*tape.level).girth_m - ((*truth).*tape.level).girth_m) * 1000);
  }
}

}  // namespace

std::vector<ScoreRow> fit(const RunOutputs& outputs, const GroundTruth& truth) {
  StageRows rows("fit");
  const auto naked = levels_of(outputs.naked_body), user = levels_of(outputs.user_body);
  add_girths(rows, "naked_body", naked, levels_of(truth.naked_body));
  add_girths(rows, "user_body", user, levels_of(truth.user_body));
  for (const auto& [slot, true_garment] : truth.garments) {
    const GarmentOutput* garment = fitted_of(outputs, slot);
    add_ease(rows, slot, garment, naked, user);
    if (garment && garment->mesh.triangles == garment->fitted.triangles)
      rows.add(slot + "/edge_stretch_p95@1", "1", edge_stretch_p95(garment->mesh, garment->fitted),
               static_cast<long>(garment->mesh.triangles.size()));
    else
      rows.fail(slot + "/edge_stretch_p95@1", "1");
  }
  return rows.rows;
}

std::vector<ScoreRow> correction(const RunOutputs& outputs, const GroundTruth& truth, Seed seed) {
  StageRows rows("correct");
  for (const auto& [slot, true_garment] : truth.garments) {
    const GarmentOutput* garment = fitted_of(outputs, slot);
    const bool possible = garment && !outputs.user_body.triangles.empty();
    const auto add = [&, slot = slot](const char* name, const char* unit, double value, long samples) {
      if (possible)
        rows.add(slot + "/" + name, unit, value, samples);
      else
        rows.fail(slot + "/" + name, unit);
    };
    const long triangles = possible ? static_cast<long>(garment->fitted.triangles.size()) : 0;
    const Penetration depth = possible ? penetration(garment->fitted, outputs.user_body, 0.004, seed) : Penetration{};
    add("intersecting_pairs@1", "count", possible ? intersecting_pairs(garment->fitted, outputs.user_body) : 0,
        triangles);
    add("self_intersecting_pairs@1", "count", possible ? self_intersecting_pairs(garment->fitted) : 0, triangles);
    add("components_inside@1", "count", depth.components_inside, triangles);
    add("penetration_area_cm2@1", "cm2", depth.area_cm2, depth.samples);
    add("penetration_mean_mm@1", "mm", depth.mean_mm, depth.samples);
    add("penetration_p95_mm@1", "mm", depth.p95_mm, depth.samples);
    add("penetration_max_mm@1", "mm", depth.max_mm, depth.samples);
  }
  return rows.rows;
}

}  // namespace dressform::evaluation
