#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/metrics/rim_metrics.h"
#include "eval/metrics/sampling.h"
#include "eval/score/metric_family.h"

namespace dressform {
namespace {
using namespace metrics;

constexpr double kObservedRim = 0.5;  // a rim of which less is visible is not judged in the garment's rim scores

void judge_open(const Judged& run, StageRows& rows);

const char* const kHungarian = "Kuhn, NRLQ 1955";
const MetricFamily open_metrics{
    "open",
    "open",
    {Metric{"<slot>/loops", 1, "count", Better::neither, "Boundary loops of the garment."}.with_headline("openings"),
     Metric{"<slot>/loop_difference", 1, "count", Better::lower, "How many loops too many or too few."}
         .with_target(0, 0.4)
         .with_headline("openings too many or few"),
     {"<slot>/components", 1, "count", Better::lower, "Connected parts of the garment; 1 is right."},
     {"<slot>/euler", 1, "count", Better::neither, "V - E + F."},
     {"<slot>/non_manifold_edges", 1, "count", Better::lower, "Edges of more than two triangles."},
     Metric{"<slot>/boundary_identity", 1, "count", Better::near_zero,
            "B - (2V - F - 2 chi), B the boundary edges, chi of a sphere with the true number of holes: 0 when the "
            "class is right."}
         .with_target(0, 0.4)
         .with_headline("B - (2V - F - 2 chi)"),
     Metric{"<slot>/rim_<rim>_chamfer_mm", 1, "mm", Better::lower,
            "True rim against the loop that the Hungarian method gives it: mean distance of points 1 mm apart to the "
            "other's segments."}
         .after(kHungarian),
     Metric{"<slot>/rim_<rim>_hd95_mm", 1, "mm", Better::lower, "The same, 95th percentile."}.after(kHungarian),
     {"<slot>/rims_chamfer_mm", 1, "mm", Better::lower,
      "Mean over the rims of which at least half is visible; an unmatched rim or loop counts 200 mm."},
     Metric{"<slot>/rims_hd95_mm", 1, "mm", Better::lower, "The worst of them, likewise."}
         .with_target(25, 1.0)
         .with_headline("worst rim HD95"),
     {"<slot>/rims_length_error", 1, "1", Better::lower,
      "Mean of abs(length / true length - 1) over them; an unmatched one counts 1."}},
    judge_open};

struct RimScore {
  LineDistance distance{kUnmatchedRimMm, kUnmatchedRimMm};
  double length_error = 1;
};

RimScore score_rim(const std::vector<ClosedLine>& loops, int loop, const ClosedLine& rim) {
  if (loop < 0) return {};
  return {compare_lines(loops[loop], rim), std::abs(closed_length(loops[loop]) / closed_length(rim) - 1)};
}

std::optional<std::vector<ClosedLine>> world_loops(const Mesh& mesh, const Isometry3d& world_from_model) {
  std::vector<ClosedLine> lines;
  try {
    for (const auto& loop : boundary_loops(mesh)) {
      lines.emplace_back();
      for (const int vertex : loop) lines.back().push_back(world_from_model * mesh.vertices[vertex]);
    }
  } catch (const std::invalid_argument&) {  // an edge of more than two triangles: the mesh has no proper boundary
    return {};
  }
  return lines;
}

// Where the truth has no rims of the garment, what asks for their number is absent.
void add_topology(StageRows& rows, const std::string& slot, const GarmentOutput* garment,
                  std::optional<int> true_loops) {
  const Topology t = garment ? topology(garment->mesh) : Topology{};
  const int expected = true_loops.value_or(0), euler_of_class = 2 - expected;  // a sphere with that many holes
  const auto add = [&](const std::string& metric, int value, bool known = true) {
    if (!known)
      rows.absent(metric, {slot});
    else if (garment)
      rows.add(metric, {slot}, value, t.triangles);
    else
      rows.fail(metric, {slot});
  };
  add("<slot>/loops", t.loops);
  add("<slot>/loop_difference", std::abs(t.loops - expected), true_loops.has_value());
  add("<slot>/components", t.components);
  add("<slot>/euler", t.euler());
  add("<slot>/non_manifold_edges", t.non_manifold_edges);
  add("<slot>/boundary_identity", t.boundary_edges - (2 * t.vertices - t.triangles - 2 * euler_of_class),
      true_loops.has_value());
}

// What the rims that count give together.
struct RimTotals {
  std::vector<double> chamfer_mm, hd95_mm, length_error;
  void add(const RimScore& score) {
    chamfer_mm.push_back(score.distance.chamfer_mm);
    hd95_mm.push_back(score.distance.hd95_mm);
    length_error.push_back(score.length_error);
  }
};

void add_rim(StageRows& rows, const std::string& slot, const TruthRim& rim, const RimScore& score, bool matched) {
  const auto samples = static_cast<long>(rim.points.size());
  for (const auto& [metric, value] : {std::pair("<slot>/rim_<rim>_chamfer_mm", score.distance.chamfer_mm),
                                      std::pair("<slot>/rim_<rim>_hd95_mm", score.distance.hd95_mm)})
    if (matched)
      rows.add(metric, {slot, rim.name}, value, samples);
    else
      rows.fail(metric, {slot, rim.name});
}

RimTotals add_each_rim(StageRows& rows, const std::string& slot, const std::vector<ClosedLine>& loops,
                       const std::vector<TruthRim>& rims) {
  std::vector<ClosedLine> lines;
  for (const auto& rim : rims) lines.push_back(rim.points);
  const auto matched = match_lines(loops, lines);
  RimTotals totals;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    const RimScore score = score_rim(loops, matched[i], lines[i]);
    add_rim(rows, slot, rims[i], score, matched[i] >= 0);
    if (rims[i].visible >= kObservedRim) totals.add(score);
  }
  for (std::size_t extra = rims.size(); extra < loops.size(); ++extra) totals.add({});
  return totals;
}

void add_rims(StageRows& rows, const std::string& slot, const std::optional<std::vector<ClosedLine>>& loops,
              const std::vector<TruthRim>& rims, const std::string& status_without) {
  RimTotals totals;
  if (loops)
    totals = add_each_rim(rows, slot, *loops, rims);
  else
    for (const auto& rim : rims)
      for (const char* metric : {"<slot>/rim_<rim>_chamfer_mm", "<slot>/rim_<rim>_hd95_mm"})
        rows.without_value(metric, {slot, rim.name}, status_without);
  const auto add = [&](const std::string& metric, double value) {
    if (!loops)
      rows.without_value(metric, {slot}, status_without);
    else if (totals.hd95_mm.empty())
      rows.absent(metric, {slot});
    else
      rows.add(metric, {slot}, value, static_cast<long>(totals.hd95_mm.size()));
  };
  add("<slot>/rims_chamfer_mm", mean(totals.chamfer_mm));
  add("<slot>/rims_hd95_mm", quantile(totals.hd95_mm, 1));
  add("<slot>/rims_length_error", mean(totals.length_error));
}

void judge_open(const Judged& run, StageRows& rows) {
  for (const auto& slot : judged_slots(run)) {
    const GarmentOutput* estimate = garment_of(run.outputs, slot);
    const auto rims = run.truth.rims.find(slot);
    const bool known = rims != run.truth.rims.end();
    const auto true_rims = known ? rims->second : std::vector<TruthRim>{};
    add_topology(rows, slot, estimate, known ? std::optional<int>(true_rims.size()) : std::nullopt);
    std::optional<std::vector<ClosedLine>> loops;
    if (known && estimate && run.world_from_model) loops = world_loops(estimate->mesh, *run.world_from_model);
    add_rims(rows, slot, loops, true_rims, known ? run.status_without_world : "absent");
  }
}

}  // namespace
}  // namespace dressform
