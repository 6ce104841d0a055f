#include "eval/score/surface_values.h"

namespace dressform {
namespace {
using namespace metrics;

void judge_surface(const Judged& run, StageRows& rows);

const std::vector<SurfaceValue> kPartValues{
    {"f_2mm", [](const SurfaceComparison& c) { return c.f.at(2); }},
    {"f_5mm", [](const SurfaceComparison& c) { return c.f.at(5); }},
    {"f_10mm", [](const SurfaceComparison& c) { return c.f.at(10); }},
    {"precision_5mm", [](const SurfaceComparison& c) { return c.precision.at(5); }},
    {"recall_5mm", [](const SurfaceComparison& c) { return c.recall.at(5); }},
    {"precision_10mm", [](const SurfaceComparison& c) { return c.precision.at(10); }},
    {"recall_10mm", [](const SurfaceComparison& c) { return c.recall.at(10); }},
    {"unobserved_part", [](const SurfaceComparison& c) { return c.unobserved_part; }},
    {"unjudged_part", [](const SurfaceComparison& c) { return c.estimate_unjudged_part; }}};

std::vector<Metric> part_metrics() {
  const char *const tanks = "Knapitsch et al., TOG 2017", *const eth3d = "Schoeps et al., CVPR 2017";
  const auto f = [&](const std::string& mm) {
    return Metric{"<slot>/f_" + mm + "mm", 1, "1", Better::higher,
                  "F = 2PR / (P + R) of precision and recall at " + mm + " mm, 0 if both are 0."}
        .after(tanks);
  };
  const auto precision = [&](const std::string& mm) {
    return Metric{"<slot>/precision_" + mm + "mm", 1, "1", Better::higher,
                  "Part of the estimated area within " + mm + " mm of the true surface."}
        .after(tanks);
  };
  const auto recall = [&](const std::string& mm) {
    return Metric{"<slot>/recall_" + mm + "mm", 1, "1", Better::higher,
                  "Part of the observed true area within " + mm + " mm of the estimate."}
        .after(tanks);
  };
  return {f("2"),
          f("5").with_target(0.85, 1.0).with_headline("F at 5 mm"),
          f("10").with_target(0.93, 0.6).with_headline("F at 10 mm"),
          precision("5"),
          recall("5"),
          precision("10"),
          recall("10"),
          Metric{"<slot>/unobserved_part", 1, "1", Better::neither, "Part of the true area that no sensor saw."}.after(
              eth3d),
          Metric{"<slot>/unjudged_part", 1, "1", Better::neither,
                 "Part of the estimated area that lies nearest to truth that no sensor saw."}
              .after(eth3d)};
}

std::vector<Metric> declared() {
  auto result = part_metrics();
  auto distances = distance_metrics("<slot>");
  distances[1] = distances[1].with_target(2.5, 1.0).with_headline("median accuracy");
  distances[3] = distances[3].with_headline("median completeness");
  result.insert(result.end(), distances.begin(), distances.end());
  result.push_back({"unexpected_garments", 1, "count", Better::lower, "Garments that nobody wears."});
  return result;
}

const MetricFamily surface_metrics{"surface", "surface", declared(), judge_surface};

void judge_surface(const Judged& run, StageRows& rows) {
  for (const auto& slot : judged_slots(run)) {
    const auto truth = run.truth.garments.find(slot);
    const GarmentOutput* estimate = garment_of(run.outputs, slot);
    std::optional<SurfaceComparison> comparison;
    if (estimate && truth != run.truth.garments.end())
      comparison = compared_in_world(estimate->mesh, run.world_from_model, truth->second.mesh, truth->second.views,
                                     run.options.sample_spacing_m, run.options.seed);
    const std::string without = truth == run.truth.garments.end() ? "absent" : run.status_without_world;
    add_values(rows, "<slot>", slot, kPartValues, comparison, without);
    add_values(rows, "<slot>", slot, distance_values(), comparison, without);
  }
  if (run.truth.garments.empty()) return rows.absent("unexpected_garments", {});
  double unexpected = 0;
  for (const auto& [slot, garment] : run.outputs.garments) unexpected += run.truth.garments.count(slot) == 0;
  rows.add("unexpected_garments", {}, unexpected);
}

}  // namespace
}  // namespace dressform
