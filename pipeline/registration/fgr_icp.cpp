#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/alignment/open3d_icp.h"
#include "pipeline/registration/view_clouds.h"

namespace dressform {
namespace {

struct FgrIcpParams {
  int points = 20000;
  double voxel_m = 0.025;
  int iterations = 50;
  LossWidths loss;
  AcceptanceOptions acceptance;
};
template <class V>
void fields(V& v, FgrIcpParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("voxel_m", p.voxel_m, 0.005, 0.1, "m", "edge of the cubes that features are found in one of; their reach is five");
  v("iterations", p.iterations, 1, 1000, "", "of the fine alignment, at each of three reaches");
  loss_fields(v, p.loss);
  acceptance_fields(v, p.acceptance);
}

// Every view by itself against the model, from nowhere: fast global registration of feature histograms (Zhou, Park and
// Koltun, ECCV 2016; Rusu, Blodow and Beetz, ICRA 2009), then points to planes (Chen and Medioni, ICRA 1991), all by
// Open3D as its examples do it. Neither floor nor rig prior is asked where the mannequin stands: a body looks alike
// from many sides, and a view that was put wrongly is left out by the evidence.
Registration fgr_icp(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                     const ExtractedViews& extracted, const FgrIcpParams& params, Seed seed) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  const PointCloud body = model_cloud(target, false), model = model_cloud(target);
  std::vector<ViewAlignment> alignments(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!views[v].usable()) return;
    const auto start = fast_global(view_cloud(views[v], false), body, params.voxel_m, seed);
    if (!start) return;
    const PointCloud cloud = view_cloud(views[v], target.has_floor());
    // What the features leave is up to a voxel or two off.
    Isometry3d pose =
        plane_icp(cloud, model, *start, {std::max(params.loss.wide_m, 2 * params.voxel_m), params.iterations});
    for (const double reach_m : {params.loss.middle_m, params.loss.narrow_m})
      pose = plane_icp(cloud, model, pose, {reach_m, params.iterations});
    alignments[v] = measured_at(views[v], target, pose, {params.loss.narrow_m, params.loss.normal_cosine});
  });
  return judged(views, target, alignments, params.acceptance);
}

const Register::Variant fgr_icp_variant{"fgr_icp", fgr_icp};

}  // namespace
}  // namespace dressform
