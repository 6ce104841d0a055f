#include "eval/score/surface_values.h"

#include "eval/metrics/sampling.h"

namespace dressform {
using namespace metrics;

const std::vector<SurfaceValue>& distance_values() {
  static const std::vector<SurfaceValue> values{
      {"accuracy_mm", [](const SurfaceComparison& c) { return c.accuracy_mm; }},
      {"accuracy_median_mm", [](const SurfaceComparison& c) { return c.accuracy_median_mm; }},
      {"completeness_mm", [](const SurfaceComparison& c) { return c.completeness_mm; }},
      {"completeness_median_mm", [](const SurfaceComparison& c) { return c.completeness_median_mm; }},
      {"chamfer_l1_mm", [](const SurfaceComparison& c) { return c.chamfer_l1_mm; }},
      {"hausdorff_mm", [](const SurfaceComparison& c) { return c.hausdorff_mm; }},
      {"hd95_mm", [](const SurfaceComparison& c) { return c.hd95_mm; }},
      {"normal_consistency", [](const SurfaceComparison& c) { return c.normal_consistency; }},
      {"normal_consistency_signed", [](const SurfaceComparison& c) { return c.normal_consistency_signed; }}};
  return values;
}

std::vector<Metric> distance_metrics(const std::string& family) {
  const char *const middlebury = "Seitz et al., CVPR 2006", *const metro = "Cignoni et al., Metro, CGF 1998",
                    *const occupancy = "Mescheder et al., CVPR 2019";
  return {
      Metric{family + "/accuracy_mm", 1, "mm", Better::lower,
             "Mean distance of the estimated surface's points to the true triangles."}
          .after(middlebury),
      Metric{family + "/accuracy_median_mm", 1, "mm", Better::lower, "The same, median."}.after(middlebury),
      Metric{family + "/completeness_mm", 1, "mm", Better::lower,
             "Mean distance of the true surface's points to the estimated triangles."}
          .after(middlebury),
      Metric{family + "/completeness_median_mm", 1, "mm", Better::lower, "The same, median."}.after(middlebury),
      Metric{family + "/chamfer_l1_mm", 1, "mm", Better::lower, "(accuracy + completeness) / 2, means, not squared."}
          .after("Fan et al., CVPR 2017"),
      Metric{family + "/hausdorff_mm", 1, "mm", Better::lower, "The larger of both directions' maxima."}.after(metro),
      Metric{family + "/hd95_mm", 1, "mm", Better::lower, "The larger of both directions' 95th percentiles."}.after(
          metro),
      Metric{family + "/normal_consistency", 1, "1", Better::higher,
             "Mean of abs(n.n') at the estimate's points and the nearest true triangle."}
          .after(occupancy),
      Metric{family + "/normal_consistency_signed", 1, "1", Better::higher,
             "Mean of n.n' there: a surface turned inside out shows."}
          .after(occupancy)};
}

std::optional<SurfaceComparison> compared_in_world(const Mesh& mesh, const std::optional<Isometry3d>& world_from_model,
                                                   const Mesh& truth, const std::vector<std::uint8_t>& views,
                                                   double spacing_m, Seed seed) {
  if (!world_from_model || !(surface_area(mesh) > 0) || !(surface_area(truth) > 0)) return {};
  SurfaceComparisonOptions how;
  how.spacing_m = spacing_m;
  how.seed = seed;
  return compare_surfaces(transformed(mesh, world_from_model->matrix()), truth, views, how);
}

void add_values(StageRows& rows, const std::string& family, const std::string& member,
                const std::vector<SurfaceValue>& values, const std::optional<SurfaceComparison>& comparison,
                const std::string& status_without) {
  for (const auto& value : values) {
    const std::string metric = family + "/" + value.name;
    if (comparison)
      rows.add(metric, {member}, value.value(*comparison), comparison->estimate_samples + comparison->truth_samples);
    else
      rows.without_value(metric, {member}, status_without);
  }
}

}  // namespace dressform
