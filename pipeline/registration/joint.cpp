#include <algorithm>
#include <cmath>

#include "pipeline/registration/acceptance.h"
#include "pipeline/registration/initial_poses.h"
#include "scenes/small_solvers.h"

namespace dressform {
namespace {

struct JointParams {
  int points = 8000;
  int iterations = 20;
  double overlap_weight = 0.5;
  LossWidths loss;
  InitialPoseOptions initial;
  AcceptanceOptions acceptance;
};

template <class V>
void fields(V& v, JointParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("iterations", p.iterations, 1, 200, "", "at each width of the loss");
  v("overlap_weight", p.overlap_weight, 0.0, 10.0, "", "of what two views see of one another, against the model");
  loss_fields(v, p.loss);
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

constexpr double kOverlapWidth = 2;     // of the loss between two views over that against the model: both are noisy
constexpr double kOverlapCosine = 0.8;  // least agreement of normals: two sensors see the same surface
constexpr double kAnchor = 1e-9;        // keeps what no point holds where it is
constexpr double kStill = 2e-5;         // radians and metres: a step that moves nothing by a tenth of a millimetre

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
                  const std::vector<char>& accepted, const ModelGate& gate, double overlap_weight,
                  std::vector<ViewAlignment>& alignments) {
  const std::size_t count = views.size();
  JointSystem system(count);
  for (std::size_t v = 0; v < count; ++v) {
    system.matrix.diagonal().segment<6>(6 * v).array() += accepted[v] ? kAnchor : 1.0;
    if (!accepted[v]) continue;
    const ModelEquations model = model_equations(views[v], target, alignments[v].model_from_sensor, gate);
    system.add_model(v, model);
    measure(model, alignments[v]);
    for (std::size_t w = 0; w < count; ++w) {
      if (w == v || !accepted[w] || overlap_weight == 0) continue;
      const double width_m = std::max(loss_width_m(views[v], gate.distance_m), loss_width_m(views[w], gate.distance_m));
      system.add_overlap(
          v, w,
          pair_equations(views[v].map, samples[v], views[w].map, projectors[w], alignments[v].model_from_sensor,
                         alignments[w].model_from_sensor, {kOverlapWidth * width_m, kOverlapCosine, 1}),
          overlap_weight);
    }
  }
  const Eigen::VectorXd solution = solve_symmetric(system.matrix, system.vector);
  for (std::size_t v = 0; v < count; ++v)
    if (accepted[v])
      alignments[v].model_from_sensor = exponential(solution.segment<6>(6 * v)) * alignments[v].model_from_sensor;
  return solution.cwiseAbs().maxCoeff();
}

// Every view against the model (Chen and Medioni, ICRA 1991), then all views and the model together: what two views
// share ties them to one another (Pulli, 3DIM 1999).
Registration joint(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                   const ExtractedViews& extracted, const JointParams& params) {
  check_registration_input(session, naked);
  const LossWidths& loss = params.loss;
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  auto alignments = initial_poses(views, target, params.initial);
  ViewVerdicts verdicts = no_verdicts(views.size());
  std::vector<std::vector<int>> samples;
  std::vector<Projector> projectors;
  for (std::size_t v = 0; v < views.size(); ++v) {
    samples.push_back(shared_samples(views[v]));
    projectors.emplace_back(views[v].map.camera);
    if (!alignments[v].valid) continue;
    alignments[v] =
        align_to_model(views[v], target, alignments[v].model_from_sensor,
                       {{loss.wide_m, loss.normal_cosine}, {loss.middle_m, loss.normal_cosine}}, params.iterations);
    verdicts.accepted[v] = acceptable(views[v], target, alignments[v], params.acceptance);
  }
  reject_outliers(alignments, verdicts.accepted);
  const auto alone = alignments;  // a view that fails must leave nothing in the others' poses
  do {
    alignments = alone;
    for (const double width_m : {loss.middle_m, loss.narrow_m})
      for (int i = 0; i < params.iterations; ++i)
        if (joint_step(views, samples, projectors, target, verdicts.accepted, {width_m, loss.normal_cosine},
                       params.overlap_weight, alignments) < kStill)
          break;
  } while (reject_by_evidence(views, target, alignments, params.acceptance, verdicts));
  return registration_of(views, alignments, verdicts);
}

const Register::Variant joint_variant{"joint", joint};

}  // namespace
}  // namespace dressform
