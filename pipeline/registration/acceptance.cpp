#include "pipeline/registration/acceptance.h"

#include <algorithm>

#include "scenes/error.h"

namespace dressform {

bool acceptable(const ViewPoints& view, const ModelTarget& target, const ViewAlignment& alignment,
                const AcceptanceOptions& options) {
  constexpr double kBehind = 0.05;
  return view.usable() && alignment.valid && alignment.inlier_part >= options.least_inlier_part &&
         alignment.residual_rms_m <= options.largest_residual_m &&
         contradicted_part(view, target, Projector(view.map.camera), alignment.model_from_sensor, kBehind) <=
             options.largest_contradicted_part;
}

void reject_outliers(const std::vector<ViewAlignment>& alignments, std::vector<char>& accepted) {
  std::vector<double> residuals;
  for (std::size_t v = 0; v < alignments.size(); ++v)
    if (accepted[v]) residuals.push_back(alignments[v].residual_rms_m);
  if (residuals.size() < 3) return;
  std::sort(residuals.begin(), residuals.end());
  const double limit = 2 * residuals[(residuals.size() - 1) / 2];
  for (std::size_t v = 0; v < alignments.size(); ++v)
    if (alignments[v].residual_rms_m > limit) accepted[v] = 0;
}

Registration registration_of(const std::vector<ViewPoints>& views, const std::vector<ViewAlignment>& alignments,
                             const std::vector<char>& accepted) {
  Registration result;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const std::string& sensor = views[v].sensor;
    result.converged[sensor] = accepted[v] != 0;
    result.inliers[sensor] = alignments[v].inliers;
    result.residual_rms_m[sensor] = alignments[v].residual_rms_m;
    if (accepted[v]) result.model_from_sensor[sensor] = alignments[v].model_from_sensor;
  }
  return result;
}

void check_registration_input(const CaptureSession& session, const BodyModel& naked) {
  if (naked.body.triangles.empty())
    throw InputError("registration", "the naked model has no surface; expected the result of fuse");
  if (session.sensors.empty()) throw InputError("session.json: sensors", "found none; expected at least one");
}

}  // namespace dressform
