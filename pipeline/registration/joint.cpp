#include <Eigen/Cholesky>
#include <cmath>

#include "pipeline/registration/acceptance.h"
#include "pipeline/registration/initial_poses.h"

namespace dressform {
namespace {

struct JointParams {
  int points = 8000;
  int iterations = 20;
  double overlap_weight = 0.5;
  InitialPoseOptions initial;
  AcceptanceOptions acceptance;
};

template <class V>
void fields(V& v, JointParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("iterations", p.iterations, 1, 200, "", "at each width of the loss");
  v("overlap_weight", p.overlap_weight, 0.0, 10.0, "", "of what two views see of one another, against the model");
  v("headings", p.initial.headings, 4, 360, "", "starts round the circle");
  v("prior_reach_deg", p.initial.prior_reach_deg, 5.0, 180.0, "deg", "how far a view may turn from the rig prior");
  acceptance_fields(v, p.acceptance);
}

// All that a view may share with another one: mannequin, floor and room.
std::vector<int> shared_samples(const ViewPoints& view) {
  std::vector<int> samples = view.body;
  samples.insert(samples.end(), view.floor.begin(), view.floor.end());
  samples.insert(samples.end(), view.room.begin(), view.room.end());
  return samples;
}

struct JointSystem {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd vector;
  explicit JointSystem(std::size_t views)
      : matrix(Eigen::MatrixXd::Zero(6 * views, 6 * views)), vector(Eigen::VectorXd::Zero(6 * views)) {}

  void add_model(std::size_t view, const ModelEquations& equations) {
    matrix.block<6, 6>(6 * view, 6 * view) += equations.matrix;
    vector.segment<6>(6 * view) += equations.vector;
  }
  void add_overlap(std::size_t source, std::size_t target, const PairEquations& equations, double weight) {
    const Matrix6d block = weight * equations.matrix;
    const Vector6d right = weight * equations.vector;
    matrix.block<6, 6>(6 * source, 6 * source) += block;
    matrix.block<6, 6>(6 * target, 6 * target) += block;
    matrix.block<6, 6>(6 * source, 6 * target) -= block;
    matrix.block<6, 6>(6 * target, 6 * source) -= block;
    vector.segment<6>(6 * source) += right;
    vector.segment<6>(6 * target) -= right;
  }
};

// One Gauss-Newton step of all accepted views together; the largest twist.
double joint_step(const std::vector<ViewPoints>& views, const std::vector<std::vector<int>>& samples,
                  const std::vector<Projector>& projectors, const ModelTarget& target,
                  const std::vector<char>& accepted, double distance_m, double overlap_weight,
                  std::vector<ViewAlignment>& alignments) {
  const std::size_t count = views.size();
  JointSystem system(count);
  for (std::size_t v = 0; v < count; ++v) {
    system.matrix.diagonal().segment<6>(6 * v).array() += accepted[v] ? 1e-9 : 1.0;
    if (!accepted[v]) continue;
    const ModelEquations model =
        model_equations(views[v], target, alignments[v].model_from_sensor, {distance_m, 0.7, 1 << 30});
    system.add_model(v, model);
    alignments[v].inliers = model.inliers;
    alignments[v].residual_rms_m = model.inliers ? std::sqrt(model.squared_residual_m2 / model.inliers) : 0;
    alignments[v].inlier_part = model.points ? static_cast<double>(model.inliers) / model.points : 0;
    for (std::size_t w = 0; w < count; ++w) {
      if (w == v || !accepted[w] || overlap_weight == 0) continue;
      system.add_overlap(
          v, w,
          pair_equations(views[v].map, samples[v], views[w].map, projectors[w], alignments[v].model_from_sensor,
                         alignments[w].model_from_sensor, {2 * distance_m, 0.8, 1}),
          overlap_weight);
    }
  }
  const Eigen::VectorXd solution = system.matrix.ldlt().solve(system.vector);
  for (std::size_t v = 0; v < count; ++v)
    if (accepted[v])
      alignments[v].model_from_sensor = exponential(solution.segment<6>(6 * v)) * alignments[v].model_from_sensor;
  return solution.cwiseAbs().maxCoeff();
}

// Every view against the model, then all views and the model together: what two views share ties them to one another.
Registration joint(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                   const ExtractedViews& extracted, const JointParams& params) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  auto alignments = initial_poses(views, target, params.initial);
  std::vector<char> accepted(views.size(), 0);
  std::vector<std::vector<int>> samples;
  std::vector<Projector> projectors;
  for (std::size_t v = 0; v < views.size(); ++v) {
    samples.push_back(shared_samples(views[v]));
    projectors.emplace_back(views[v].map.camera);
    if (!alignments[v].valid) continue;
    alignments[v] = align_to_model(views[v], target, alignments[v].model_from_sensor, {{0.04, 0.7}, {0.015, 0.7}},
                                   params.iterations);
    accepted[v] = acceptable(views[v], target, alignments[v], params.acceptance);
  }
  reject_outliers(alignments, accepted);
  for (const double distance_m : {0.015, 0.010})
    for (int i = 0; i < params.iterations; ++i)
      if (joint_step(views, samples, projectors, target, accepted, distance_m, params.overlap_weight, alignments) <
          2e-5)
        break;
  return registration_of(views, alignments, accepted);
}

const Register::Variant joint_variant{"joint", joint};

}  // namespace
}  // namespace dressform
