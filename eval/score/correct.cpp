#include "eval/metrics/fit_metrics.h"
#include "eval/metrics/intersections.h"
#include "eval/score/metric_family.h"

namespace dressform {
namespace {
using namespace metrics;

constexpr double kDepthSpacing_m = 0.004;  // of the points whose depth in the body is asked

void judge_correct(const Judged& run, StageRows& rows);

const MetricFamily correct_metrics{
    "correct",
    "correct",
    {Metric{"<slot>/intersecting_pairs", 1, "count", Better::lower,
            "Garment/body triangle pairs that share a point, by exact predicates."}
         .with_target(0, 0.4)
         .with_headline("triangles through the body"),
     {"<slot>/self_intersecting_pairs", 1, "count", Better::lower,
      "Pairs of the fitted garment's own triangles that meet beyond a common vertex."},
     Metric{"<slot>/components_inside", 1, "count", Better::lower,
            "Components of which a vertex has winding number 1; with no intersecting pair, 0 proves that nothing is "
            "inside."}
         .after("Jacobson et al., SIGGRAPH 2013"),
     {"<slot>/penetration_area_cm2", 1, "cm2", Better::lower, "Area of the garment deeper than 1 mm in the body."},
     {"<slot>/penetration_mean_mm", 1, "mm", Better::lower, "Mean of max(0, -signed distance) over the garment."},
     {"<slot>/penetration_p95_mm", 1, "mm", Better::lower, "The same, 95th percentile."},
     {"<slot>/penetration_max_mm", 1, "mm", Better::lower, "The same, maximum."}},
    judge_correct};

void judge_correct(const Judged& run, StageRows& rows) {
  const Mesh& body = run.outputs.user_body;
  for (const auto& slot : judged_slots(run)) {
    const GarmentOutput* garment = fitted_garment_of(run.outputs, slot);
    if (!garment || body.triangles.empty()) {
      for (const Metric& metric : correct_metrics.metrics()) rows.fail(metric.name, {slot});
      continue;
    }
    const auto triangles = static_cast<long>(garment->fitted.triangles.size());
    const Penetration depth = penetration(garment->fitted, body, kDepthSpacing_m, run.options.seed);
    const auto add = [&](const std::string& metric, double value, long samples) {
      rows.add(metric, {slot}, value, samples);
    };
    add("<slot>/intersecting_pairs", intersecting_pairs(garment->fitted, body), triangles);
    add("<slot>/self_intersecting_pairs", self_intersecting_pairs(garment->fitted), triangles);
    add("<slot>/components_inside", depth.components_inside, triangles);
    add("<slot>/penetration_area_cm2", depth.area_cm2, depth.samples);
    add("<slot>/penetration_mean_mm", depth.mean_mm, depth.samples);
    add("<slot>/penetration_p95_mm", depth.p95_mm, depth.samples);
    add("<slot>/penetration_max_mm", depth.max_mm, depth.samples);
  }
}

}  // namespace
}  // namespace dressform
