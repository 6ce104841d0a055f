#include <cmath>
#include <stdexcept>

#include "eval/evaluate_parts.h"
#include "eval/metrics/registration_metrics.h"
#include "eval/metrics/rim_metrics.h"
#include "eval/metrics/sampling.h"
#include "eval/metrics/surface_metrics.h"

namespace dressform::evaluation {
using namespace metrics;

namespace {

constexpr double kRegistrationSpacing_m = 0.02;
constexpr double kObservedRim = 0.5;  // a rim of which less is visible is not judged in the garment's rim scores

const GarmentOutput* garment_of(const RunOutputs& outputs, const std::string& slot) {
  const auto found = outputs.garments.find(slot);
  return found == outputs.garments.end() || found->second.mesh.triangles.empty() ? nullptr : &found->second;
}

std::optional<Isometry3d> pose_of(const RunOutputs& outputs, const std::string& sensor) {
  const auto pose = outputs.model_from_sensor.find(sensor);
  const auto converged = outputs.converged.find(sensor);
  if (pose == outputs.model_from_sensor.end() || converged == outputs.converged.end() || !converged->second) return {};
  return pose->second;
}

struct SurfaceValue {
  const char *name, *unit;
  double (*value)(const SurfaceComparison&);
};
const std::vector<SurfaceValue> kBodyValues{
    {"accuracy_mm@1", "mm", [](const SurfaceComparison& c) { return c.accuracy_mm; }},
    {"accuracy_median_mm@1", "mm", [](const SurfaceComparison& c) { return c.accuracy_median_mm; }},
    {"completeness_mm@1", "mm", [](const SurfaceComparison& c) { return c.completeness_mm; }},
    {"completeness_median_mm@1", "mm", [](const SurfaceComparison& c) { return c.completeness_median_mm; }},
    {"chamfer_l1_mm@1", "mm", [](const SurfaceComparison& c) { return c.chamfer_l1_mm; }},
    {"hausdorff_mm@1", "mm", [](const SurfaceComparison& c) { return c.hausdorff_mm; }},
    {"hd95_mm@1", "mm", [](const SurfaceComparison& c) { return c.hd95_mm; }},
    {"normal_consistency@1", "1", [](const SurfaceComparison& c) { return c.normal_consistency; }},
    {"normal_consistency_signed@1", "1", [](const SurfaceComparison& c) { return c.normal_consistency_signed; }}};
const std::vector<SurfaceValue> kGarmentValues{
    {"f_2mm@1", "1", [](const SurfaceComparison& c) { return c.f.at(2); }},
    {"f_5mm@1", "1", [](const SurfaceComparison& c) { return c.f.at(5); }},
    {"f_10mm@1", "1", [](const SurfaceComparison& c) { return c.f.at(10); }},
    {"precision_5mm@1", "1", [](const SurfaceComparison& c) { return c.precision.at(5); }},
    {"recall_5mm@1", "1", [](const SurfaceComparison& c) { return c.recall.at(5); }},
    {"precision_10mm@1", "1", [](const SurfaceComparison& c) { return c.precision.at(10); }},
    {"recall_10mm@1", "1", [](const SurfaceComparison& c) { return c.recall.at(10); }},
    {"unobserved_part@1", "1", [](const SurfaceComparison& c) { return c.unobserved_part; }},
    {"unjudged_part@1", "1", [](const SurfaceComparison& c) { return c.estimate_unjudged_part; }}};

void add_values(StageRows& rows, const std::string& prefix, const std::vector<SurfaceValue>& values,
                const std::optional<SurfaceComparison>& comparison) {
  for (const auto& value : values) {
    const std::string metric = prefix + "/" + value.name;
    if (comparison)
      rows.add(metric, value.unit, value.value(*comparison), comparison->estimate_samples + comparison->truth_samples);
    else
      rows.fail(metric, value.unit);
  }
}

std::optional<SurfaceComparison> compared(const Mesh& mesh, const std::optional<Isometry3d>& world_from_model,
                                          const Mesh& truth, const std::vector<std::uint8_t>& views,
                                          const EvaluateOptions& options) {
  if (!world_from_model || !(surface_area(mesh) > 0)) return {};
  SurfaceComparisonOptions how;
  how.spacing_m = options.sample_spacing_m;
  how.seed = options.seed;
  return compare_surfaces(transformed(mesh, world_from_model->matrix()), truth, views, how);
}

std::optional<Isometry3d> world_from_user_model(const RunOutputs& outputs, const GroundTruth& truth) {
  const auto poses = truth.scan_world_from_sensor.find("scan_user");
  if (!outputs.user_model_from_frame0 || poses == truth.scan_world_from_sensor.end() || poses->second.empty())
    return {};
  return poses->second.front() * outputs.user_model_from_frame0->inverse();
}

void add_body(StageRows& rows, const std::string& name, const Mesh& mesh, const Mesh& truth,
              const std::optional<Isometry3d>& world_from_model, const EvaluateOptions& options) {
  EvaluateOptions wider = options;  // no thresholds are asked of bodies
  wider.sample_spacing_m = 2 * options.sample_spacing_m;
  add_values(rows, name, kBodyValues, compared(mesh, world_from_model, truth, {}, wider));
  if (mesh.triangles.empty())
    rows.fail(name + "/closed@1", "1");
  else
    rows.add(name + "/closed@1", "1", topology(mesh).closed() ? 1 : 0, static_cast<long>(mesh.triangles.size()));
}

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

void add_topology(StageRows& rows, const std::string& slot, const GarmentOutput* garment, int true_loops) {
  const std::vector<std::string> names{"loops@1", "loop_difference@1",    "components@1",
                                       "euler@1", "non_manifold_edges@1", "boundary_identity@1"};
  if (!garment) {
    for (const auto& name : names) rows.fail(slot + "/" + name, "count");
    return;
  }
  const Topology t = topology(garment->mesh);
  const int euler_of_class = 2 - true_loops;  // a sphere with that many holes
  const int identity = t.boundary_edges - (2 * t.vertices - t.triangles - 2 * euler_of_class);
  const int values[] = {t.loops,   std::abs(t.loops - true_loops), t.components,
                        t.euler(), t.non_manifold_edges,           identity};
  for (std::size_t i = 0; i < names.size(); ++i) rows.add(slot + "/" + names[i], "count", values[i], t.triangles);
}

void add_rims(StageRows& rows, const std::string& slot, const std::optional<std::vector<ClosedLine>>& loops,
              const std::vector<TruthRim>& rims) {
  std::vector<ClosedLine> lines;
  for (const auto& rim : rims) lines.push_back(rim.points);
  const auto matched = loops ? match_lines(*loops, lines) : std::vector<int>(rims.size(), -1);
  std::vector<double> chamfer, hd95, length;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    const std::string name = slot + "/rim_" + rims[i].name;
    if (!loops || matched[i] < 0) {
      rows.fail(name + "_chamfer_mm@1", "mm");
      rows.fail(name + "_hd95_mm@1", "mm");
    }
    const RimScore score = score_rim(loops ? *loops : std::vector<ClosedLine>{}, matched[i], lines[i]);
    if (matched[i] >= 0) {
      rows.add(name + "_chamfer_mm@1", "mm", score.distance.chamfer_mm, static_cast<long>(lines[i].size()));
      rows.add(name + "_hd95_mm@1", "mm", score.distance.hd95_mm, static_cast<long>(lines[i].size()));
    }
    if (rims[i].visible < kObservedRim) continue;
    chamfer.push_back(score.distance.chamfer_mm);
    hd95.push_back(score.distance.hd95_mm);
    length.push_back(score.length_error);
  }
  for (std::size_t extra = rims.size(); loops && extra < loops->size(); ++extra) {
    chamfer.push_back(kUnmatchedRimMm);
    hd95.push_back(kUnmatchedRimMm);
    length.push_back(1);
  }
  const std::pair<const char*, double> totals[] = {{"rims_chamfer_mm@1", mean(chamfer)},
                                                   {"rims_hd95_mm@1", quantile(hd95, 1)},
                                                   {"rims_length_error@1", mean(length)}};
  for (const auto& [name, value] : totals) {
    const char* unit = std::string(name).find("_mm") != std::string::npos ? "mm" : "1";
    if (!loops)
      rows.fail(slot + "/" + name, unit);
    else if (hd95.empty())
      rows.absent(slot + "/" + name, unit);
    else
      rows.add(slot + "/" + name, unit, value, static_cast<long>(hd95.size()));
  }
}

}  // namespace

std::optional<Isometry3d> world_from_model(const RunOutputs& outputs, const GroundTruth& truth,
                                           const std::string& gauge_sensor) {
  const auto pose = pose_of(outputs, gauge_sensor);
  if (!pose) return {};
  return truth.world_from_sensor.at(gauge_sensor) * pose->inverse();
}

std::vector<ScoreRow> bodies(const RunOutputs& outputs, const GroundTruth& truth,
                             const std::optional<Isometry3d>& world_from_model, const EvaluateOptions& options) {
  StageRows rows("fuse");
  add_body(rows, "naked_body", outputs.naked_body, truth.naked_body, world_from_model, options);
  add_body(rows, "user_body", outputs.user_body, truth.user_body, world_from_user_model(outputs, truth), options);
  return rows.rows;
}

std::vector<ScoreRow> registration(const RunOutputs& outputs, const GroundTruth& truth,
                                   const std::optional<Isometry3d>& world_from_model, const std::string& gauge_sensor,
                                   Seed seed) {
  StageRows rows("registration");
  const std::vector<std::string> names{"rotation_deg@1", "translation_mm@1", "tre_mm@1"};
  const std::vector<std::string> units{"deg", "mm", "mm"};
  std::vector<double> worst(3, 0);
  bool all = world_from_model.has_value();
  for (const auto& [sensor, pose] : truth.world_from_sensor) {
    if (sensor == gauge_sensor) continue;  // joins the world: no error of its own
    const auto estimate = pose_of(outputs, sensor);
    if (!estimate || !world_from_model) {
      all = false;
      for (int k = 0; k < 3; ++k) rows.fail(sensor + "/" + names[k], units[k]);
      continue;
    }
    const Isometry3d world_from_sensor = *world_from_model * *estimate;
    const auto targets = points_seen(truth.naked_body, pose, kRegistrationSpacing_m, seed);
    const double values[] = {rotation_error_deg(world_from_sensor, pose), translation_error_mm(world_from_sensor, pose),
                             target_registration_error_mm(world_from_sensor, pose, targets)};
    for (int k = 0; k < 3; ++k) {
      rows.add(sensor + "/" + names[k], units[k], values[k], k == 2 ? static_cast<long>(targets.size()) : 1);
      worst[k] = std::max(worst[k], values[k]);
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (all)
      rows.add("max/" + names[k], units[k], worst[k], static_cast<long>(truth.world_from_sensor.size()) - 1);
    else
      rows.fail("max/" + names[k], units[k]);
  }
  return rows.rows;
}

std::vector<ScoreRow> surfaces(const RunOutputs& outputs, const GroundTruth& truth,
                               const std::optional<Isometry3d>& world_from_model, const EvaluateOptions& options) {
  StageRows rows("surface");
  for (const auto& [slot, garment] : truth.garments) {
    const GarmentOutput* estimate = garment_of(outputs, slot);
    std::optional<SurfaceComparison> comparison;
    if (estimate) comparison = compared(estimate->mesh, world_from_model, garment.mesh, garment.views, options);
    add_values(rows, slot, kGarmentValues, comparison);
    add_values(rows, slot, kBodyValues, comparison);
  }
  double unexpected = 0;
  for (const auto& [slot, garment] : outputs.garments) unexpected += truth.garments.count(slot) == 0;
  rows.add("unexpected_garments@1", "count", unexpected);
  return rows.rows;
}

std::vector<ScoreRow> openings(const RunOutputs& outputs, const GroundTruth& truth,
                               const std::optional<Isometry3d>& world_from_model) {
  StageRows rows("open");
  for (const auto& [slot, garment] : truth.garments) {
    const GarmentOutput* estimate = garment_of(outputs, slot);
    const auto rims = truth.rims.find(slot);
    const std::vector<TruthRim> none;
    const auto& true_rims = rims == truth.rims.end() ? none : rims->second;
    add_topology(rows, slot, estimate, static_cast<int>(true_rims.size()));
    std::optional<std::vector<ClosedLine>> loops;
    if (estimate && world_from_model) loops = world_loops(estimate->mesh, *world_from_model);
    add_rims(rows, slot, loops, true_rims);
  }
  return rows.rows;
}

}  // namespace dressform::evaluation
