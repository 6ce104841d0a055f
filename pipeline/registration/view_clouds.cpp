#include "pipeline/registration/view_clouds.h"

namespace dressform {
namespace {

constexpr double kFloorReach_m = 1.2,
                 kFloorStep_m = 0.02;  // half the edge of the model's floor, and between its points
constexpr int kLeastOfFit = 40;        // inliers, as of every variant

void add_points(const DepthMap& map, const std::vector<int>& indices, PointCloud& cloud) {
  for (const int i : indices) {
    cloud.points.push_back(map.points[i].cast<double>());
    cloud.normals.push_back(map.normals[i].cast<double>());
  }
}

}  // namespace

PointCloud view_cloud(const ViewPoints& view, bool floor) {
  PointCloud cloud;
  add_points(view.map, view.body, cloud);
  if (floor) add_points(view.map, view.floor, cloud);
  return cloud;
}

PointCloud model_cloud(const ModelTarget& target, bool floor) {
  PointCloud cloud;
  cloud.points = target.query().mesh().vertices;
  cloud.normals = target.vertex_normals();
  if (!floor || !target.has_floor()) return cloud;
  const int half = static_cast<int>(kFloorReach_m / kFloorStep_m);
  for (int i = -half; i <= half; ++i)
    for (int k = -half; k <= half; ++k) {
      cloud.points.emplace_back(i * kFloorStep_m, 0, k * kFloorStep_m);
      cloud.normals.push_back(Vector3d::UnitY());
    }
  return cloud;
}

ViewAlignment measured_at(const ViewPoints& view, const ModelTarget& target, const Isometry3d& model_from_sensor,
                          const ModelGate& gate) {
  ViewAlignment result;
  result.model_from_sensor = model_from_sensor;
  const ModelEquations fit = model_equations(view, target, model_from_sensor, gate);
  measure(fit, result);
  result.cost = fit.points ? fit.cost / fit.points : 1;
  result.valid = fit.inliers >= kLeastOfFit;
  return result;
}

Registration judged(const std::vector<ViewPoints>& views, const ModelTarget& target,
                    const std::vector<ViewAlignment>& alignments, const AcceptanceOptions& options) {
  ViewVerdicts verdicts = no_verdicts(views.size());
  for (std::size_t v = 0; v < views.size(); ++v)
    if (alignments[v].valid) verdicts.accepted[v] = acceptable(views[v], target, alignments[v], options);
  reject_outliers(alignments, verdicts.accepted);
  while (reject_by_evidence(views, target, alignments, options, verdicts)) {
  }
  return registration_of(views, alignments, verdicts);
}

}  // namespace dressform
