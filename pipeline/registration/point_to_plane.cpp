#include "pipeline/registration/acceptance.h"
#include "pipeline/registration/initial_poses.h"

namespace dressform {
namespace {

struct PointToPlaneParams {
  int points = 6000;
  int iterations = 20;
  LossWidths loss;
  InitialPoseOptions initial;
  AcceptanceOptions acceptance;
};

template <class V>
void fields(V& v, PointToPlaneParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("iterations", p.iterations, 1, 200, "", "at each of three widths of the loss");
  loss_fields(v, p.loss);
  v("headings", p.initial.headings, 4, 360, "", "starts round the circle");
  v("prior_reach_deg", p.initial.prior_reach_deg, 5.0, 180.0, "deg", "how far a view may turn from the rig prior");
  acceptance_fields(v, p.acceptance);
}

// Every view by itself against the model (Chen and Medioni, ICRA 1991), with a loss that narrows.
Registration point_to_plane(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                            const ExtractedViews& extracted, const PointToPlaneParams& params) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  auto alignments = initial_poses(views, target, params.initial);
  std::vector<ModelGate> gates;
  for (const double width_m : {params.loss.wide_m, params.loss.middle_m, params.loss.narrow_m})
    gates.push_back({width_m, params.loss.normal_cosine});
  ViewVerdicts verdicts = no_verdicts(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!alignments[v].valid) continue;
    alignments[v] = align_to_model(views[v], target, alignments[v].model_from_sensor, gates, params.iterations);
    verdicts.accepted[v] = acceptable(views[v], target, alignments[v], params.acceptance);
  }
  reject_outliers(alignments, verdicts.accepted);
  while (reject_by_evidence(views, target, alignments, params.acceptance, verdicts)) {
  }
  return registration_of(views, alignments, verdicts);
}

const Register::Variant point_to_plane_variant{"point_to_plane", point_to_plane};

}  // namespace
}  // namespace dressform
