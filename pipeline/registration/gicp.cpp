#include <tbb/parallel_for.h>

#include "pipeline/alignment/open3d_icp.h"
#include "pipeline/registration/view_clouds.h"

namespace dressform {
namespace {

struct GicpParams {
  int points = 6000;
  int iterations = 50;
  LossWidths loss;
  InitialPoseOptions initial;
  AcceptanceOptions acceptance;
};
template <class V>
void fields(V& v, GicpParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("iterations", p.iterations, 1, 1000, "", "at each of three reaches");
  loss_fields(v, p.loss);
  v("headings", p.initial.headings, 4, 360, "", "starts round the circle");
  v("prior_reach_deg", p.initial.prior_reach_deg, 5.0, 180.0, "deg", "how far a view may turn from the rig prior");
  acceptance_fields(v, p.acceptance);
}

// Every view by itself against the model's vertices and its floor, planes against planes (Segal, Haehnel and Thrun,
// "Generalized-ICP", RSS 2009), by Open3D, with a reach that narrows as the other variants' losses do.
Registration gicp(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                  const ExtractedViews& extracted, const GicpParams& params) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  const PointCloud model = model_cloud(target);
  auto alignments = initial_poses(views, target, params.initial);
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!alignments[v].valid) return;
    const PointCloud cloud = view_cloud(views[v], target.has_floor());
    Isometry3d pose = alignments[v].model_from_sensor;
    for (const double reach_m : {params.loss.wide_m, params.loss.middle_m, params.loss.narrow_m})
      pose = generalized_icp(cloud, model, pose, {reach_m, params.iterations});
    alignments[v] = measured_at(views[v], target, pose, {params.loss.narrow_m, params.loss.normal_cosine});
  });
  return judged(views, target, alignments, params.acceptance);
}

const Register::Variant gicp_variant{"gicp", gicp};

}  // namespace
}  // namespace dressform
