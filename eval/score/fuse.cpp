#include "eval/score/surface_values.h"

namespace dressform {
namespace {
using namespace metrics;

void judge_fuse(const Judged& run, StageRows& rows);

std::vector<Metric> declared() {
  auto result = distance_metrics("<body>");
  result[1] = result[1].with_headline("<body>, median");
  result.push_back({"<body>/closed", 1, "1", Better::higher, "1 when every edge has two triangles."});
  return result;
}

const MetricFamily fuse_metrics{"fuse", "fuse", declared(), judge_fuse};

void add_body(StageRows& rows, const Judged& run, const std::string& name, const Mesh& mesh, const Mesh& truth,
              const std::optional<Isometry3d>& world_from_model, bool truth_says_where) {
  const double spacing_m = 2 * run.options.sample_spacing_m;  // no thresholds are asked of bodies
  add_values(rows, "<body>", name, distance_values(),
             compared_in_world(mesh, world_from_model, truth, {}, spacing_m, run.options.seed),
             truth.triangles.empty() || !truth_says_where ? "absent" : "failed");
  if (mesh.triangles.empty())
    rows.fail("<body>/closed", {name});
  else
    rows.add("<body>/closed", {name}, topology(mesh).closed() ? 1 : 0, static_cast<long>(mesh.triangles.size()));
}

// The user's scan has a frame of its own; it is joined through its first frame.
void judge_fuse(const Judged& run, StageRows& rows) {
  add_body(rows, run, "naked_body", run.outputs.naked_body, run.truth.naked_body, run.world_from_model,
           run.status_without_world != "absent");
  const auto poses = run.truth.scan_world_from_sensor.find("scan_user");
  const bool known = poses != run.truth.scan_world_from_sensor.end() && !poses->second.empty();
  std::optional<Isometry3d> world_from_user_model;
  if (known && run.outputs.user_model_from_frame0)
    world_from_user_model = poses->second.front() * run.outputs.user_model_from_frame0->inverse();
  add_body(rows, run, "user_body", run.outputs.user_body, run.truth.user_body, world_from_user_model, known);
}

}  // namespace
}  // namespace dressform
