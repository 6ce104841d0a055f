#include "pipeline/registration/acceptance.h"

#include <algorithm>

#include "pipeline/registration/evidence.h"
#include "scenes/error.h"
#include "scenes/statistics.h"

namespace dressform {

bool acceptable(const ViewPoints& view, const ModelTarget& target, const ViewAlignment& alignment,
                const AcceptanceOptions& options) {
  constexpr double kBehind = 0.05;  // metres: noise and a loose cable do not count
  // Where the sensor is noisier than its kind, so is what fits.
  const double largest_residual_m = std::max(options.largest_residual_m, 1.5 * alignment.expected_rms_m);
  return view.usable() && alignment.valid && alignment.inlier_part >= options.least_inlier_part &&
         alignment.residual_rms_m <= largest_residual_m &&
         contradicted_part(view, target, Projector(view.map.camera), alignment.model_from_sensor, kBehind) <=
             options.largest_contradicted_part;
}

void reject_outliers(const std::vector<ViewAlignment>& alignments, std::vector<char>& accepted) {
  std::vector<double> residuals;
  for (std::size_t v = 0; v < alignments.size(); ++v)
    if (accepted[v]) residuals.push_back(alignments[v].residual_rms_m);
  if (residuals.size() < 3) return;
  constexpr double kOutOfLine = 2;
  const std::size_t middle = (residuals.size() - 1) / 2;  // the lower median: one bad view of two must not set it
  const double limit = kOutOfLine * nth_value(std::move(residuals), middle);
  for (std::size_t v = 0; v < alignments.size(); ++v)
    if (alignments[v].residual_rms_m > limit) accepted[v] = 0;
}

bool reject_by_evidence(const std::vector<ViewPoints>& views, const ModelTarget& target,
                        const std::vector<ViewAlignment>& alignments, const AcceptanceOptions& options,
                        ViewVerdicts& verdicts) {
  const auto evidence = gather_evidence(views, target, alignments, verdicts.accepted);
  int worst = -1;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!verdicts.accepted[v]) continue;
    verdicts.evidence[v] = evidence[v];
    verdicts.problems[v] = problem_with(evidence[v], options);
    if (verdicts.problems[v].empty()) continue;
    if (worst < 0 || evidence[v].translation_sigma_m > evidence[worst].translation_sigma_m) worst = static_cast<int>(v);
  }
  if (worst < 0) return false;
  verdicts.accepted[worst] = 0;
  return true;
}

Registration registration_of(const std::vector<ViewPoints>& views, const std::vector<ViewAlignment>& alignments,
                             const ViewVerdicts& verdicts) {
  Registration result;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const std::string& sensor = views[v].sensor;
    result.converged[sensor] = verdicts.accepted[v] != 0;
    result.inliers[sensor] = alignments[v].inliers;
    result.residual_rms_m[sensor] = alignments[v].residual_rms_m;
    if (verdicts.evidence[v].inlier_part > 0) result.evidence[sensor] = verdicts.evidence[v];
    if (verdicts.accepted[v])
      result.model_from_sensor[sensor] = alignments[v].model_from_sensor;
    else
      result.problem[sensor] = !verdicts.problems[v].empty() ? verdicts.problems[v]
                               : !views[v].usable()          ? "no mannequin was seen in its naked shot"
                                                             : "nothing fits: residual, free space or too few points";
  }
  return result;
}

void check_registration_input(const CaptureSession& session, const BodyModel& naked) {
  if (naked.body.triangles.empty())
    throw InputError("registration", "the naked model has no surface; expected the result of fuse");
  if (session.sensors.empty()) throw InputError("session.json: sensors", "found none; expected at least one");
}

}  // namespace dressform
