#include "pipeline/registration/each_view.h"

#include <tbb/parallel_for.h>

namespace dressform {

Registration register_each_view(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                                const ExtractedViews& extracted, const EachViewOptions& options,
                                const AlignView& align) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, options.points);
  const ModelTarget target(naked);
  auto alignments = initial_poses(views, target, options.initial);
  std::vector<ModelGate> gates;
  for (const double width_m : {options.loss.wide_m, options.loss.middle_m, options.loss.narrow_m})
    gates.push_back({width_m, options.loss.normal_cosine});
  ViewVerdicts verdicts = no_verdicts(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!alignments[v].valid) return;
    alignments[v] = align(views[v], target, alignments[v].model_from_sensor, gates, options.iterations);
    verdicts.accepted[v] = acceptable(views[v], target, alignments[v], options.acceptance);
  });
  reject_outliers(alignments, verdicts.accepted);
  while (reject_by_evidence(views, target, alignments, options.acceptance, verdicts)) {
  }
  return registration_of(views, alignments, verdicts);
}

}  // namespace dressform
