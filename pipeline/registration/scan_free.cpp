#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/registration/view_clouds.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

struct ScanFreeParams {
  int points = 8000;
  int iterations = 30;
  double far_m = 0.10, wide_m = 0.04, narrow_m = 0.015;
  double turn_deg = 30;
  LossWidths loss;
  AcceptanceOptions acceptance;
};
template <class V>
void fields(V& v, ScanFreeParams& p) {
  v("points", p.points, 200, 200000, "", "of the mannequin used in every view");
  v("iterations", p.iterations, 1, 200, "", "at each width of the loss between views");
  v("far_m", p.far_m, 0.02, 0.5, "m", "width of the loss between two views at first: what headings are off");
  v("wide_overlap_m", p.wide_m, 0.01, 0.2, "m", "width of the loss between two views then");
  v("narrow_overlap_m", p.narrow_m, 0.003, 0.1, "m", "width of the loss between two views at last");
  v("turn_deg", p.turn_deg, 0, 90, "deg",
    "how far a view may be turned about the mannequin from where the prior has it");
  loss_fields(v, p.loss);
  acceptance_fields(v, p.acceptance);
}

constexpr double kHalfBody_m = 0.08;      // from the middle of what is seen of a body to its axis
constexpr double kTurnStep_deg = 3;       // of the search for headings: half of what far_m allows at arm's length
constexpr int kTurnRounds = 3;            // of it, every view against the others
constexpr int kTurnStride = 4;            // of the points that it looks at
constexpr double kLeastNormals = 0.8;     // cosine: two sensors see the same surface
constexpr double kLeastSigmasOfPair = 3;  // of both views' noise, that the loss is at least wide
constexpr int kLeastVisible = 50;         // points in another view's image, to say anything
constexpr double kGaugeDamping = 1e-9;    // of the trace: keeps where it is what the views can't tell, the whole rig
constexpr double kStillOverlap = 2e-5;    // radians and metres: a step that moves nothing by a tenth of a millimetre
constexpr double kFloorSigma_m = 0.003;   // of a floor, which is never quite flat
constexpr double kFloorWidth_m = 0.03;    // of its loss
constexpr double kBehind_m = 0.06;        // seen behind the model by more than this speaks against a heading
constexpr int kHeadings = 36, kRigIterations = 15;

// The views of one rig: poses in a frame with y up, the floor at 0 and the mannequin's axis at x = z = 0.
struct FreeRig {
  const std::vector<ViewPoints>& views;
  std::vector<std::size_t> used;
  std::vector<std::vector<int>> samples;
  std::vector<Projector> projectors;
  std::vector<Isometry3d> rig_from_sensor;
};

// By the prior, stood upright on the view's own floor and moved level to where its mannequin is over the origin.
Isometry3d stood_up(const ViewPoints& view) {
  Isometry3d pose = *view.world_from_sensor;
  const Vector3d up = pose.linear() * view.floor_plane->head<3>();
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitY()).toRotationMatrix() * pose.linear();
  pose.translation() = Vector3d(0, (*view.floor_plane)[3], 0);
  std::vector<double> x, z;
  for (const int i : view.body) {
    const Vector3d p = pose * view.map.points[i].cast<double>();
    x.push_back(p.x()), z.push_back(p.z());
  }
  const Vector3d middle(lower_quantile(x, 0.5), 0, lower_quantile(z, 0.5));
  pose.translation() -= middle + kHalfBody_m * middle.normalized();
  pose.translation().y() = (*view.floor_plane)[3];
  return pose;
}

FreeRig free_rig(const std::vector<ViewPoints>& views) {
  FreeRig rig{views, {}, {}, {}, std::vector<Isometry3d>(views.size(), Isometry3d::Identity())};
  for (std::size_t v = 0; v < views.size(); ++v) {
    rig.projectors.emplace_back(views[v].map.camera);
    rig.samples.push_back(views[v].body);
    rig.samples[v].insert(rig.samples[v].end(), views[v].floor.begin(), views[v].floor.end());
    rig.samples[v].insert(rig.samples[v].end(), views[v].room.begin(), views[v].room.end());
    if (!views[v].usable() || !views[v].floor_plane || !views[v].world_from_sensor) continue;
    rig.used.push_back(v);
    rig.rig_from_sensor[v] = stood_up(views[v]);
  }
  return rig;
}

PairEquations overlap(const FreeRig& rig, std::size_t from, std::size_t to, const Isometry3d& from_pose,
                      const Isometry3d& to_pose, double width_m, int stride) {
  const double noise_m = std::hypot(rig.views[from].body_sigma_m, rig.views[to].body_sigma_m);
  return pair_equations(rig.views[from].map, rig.samples[from], rig.views[to].map, rig.projectors[to], from_pose,
                        to_pose, {std::max(width_m, kLeastSigmasOfPair * noise_m), kLeastNormals, stride});
}

// What a view's mannequin, floor and room cost in the others' images and theirs in its, a point.
double cost_in(const FreeRig& rig, std::size_t v, const Isometry3d& pose, double width_m) {
  double cost = 0;
  int visible = 0;
  for (const std::size_t w : rig.used) {
    if (w == v) continue;
    const Isometry3d& other = rig.rig_from_sensor[w];
    for (const PairEquations& pair :
         {overlap(rig, v, w, pose, other, width_m, kTurnStride), overlap(rig, w, v, other, pose, width_m, kTurnStride)})
      cost += pair.cost, visible += pair.visible;
  }
  return visible < kLeastVisible ? 1 : cost / visible;
}

// Every view but the first turned about the mannequin to where it fits the others best.
void find_headings(FreeRig& rig, const ScanFreeParams& params) {
  const int steps = static_cast<int>(params.turn_deg / kTurnStep_deg);
  const auto start = rig.rig_from_sensor;
  for (int round = 0; round < kTurnRounds; ++round)
    for (std::size_t k = 1; k < rig.used.size(); ++k) {
      const std::size_t v = rig.used[k];
      std::vector<double> costs(2 * steps + 1);
      const auto turned = [&](int step) -> Isometry3d {
        return Eigen::AngleAxisd((step - steps) * kTurnStep_deg * M_PI / 180, Vector3d::UnitY()) * start[v];
      };
      tbb::parallel_for(0, static_cast<int>(costs.size()),
                        [&](int i) { costs[i] = cost_in(rig, v, turned(i), params.far_m); });
      rig.rig_from_sensor[v] = turned(static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin()));
    }
}

// The view's own floor held to y = 0.
void add_floor(const ViewPoints& view, const Isometry3d& pose, Matrix6d& matrix, Vector6d& vector) {
  for (const int i : view.floor) {
    const Vector3d p = pose * view.map.points[i].cast<double>();
    const Tukey tukey(p.y() / kFloorWidth_m);
    Vector6d jacobian;
    jacobian << p.cross(Vector3d::UnitY()), Vector3d::UnitY();
    const double sigma = view.map.sigma_m[i];
    const double weight = 1e-6 * tukey.weight / (sigma * sigma + kFloorSigma_m * kFloorSigma_m);
    matrix += weight * jacobian * jacobian.transpose();
    vector -= weight * p.y() * jacobian;
  }
}

// One Gauss-Newton step of all views together; its largest twist.
double overlap_step(FreeRig& rig, double width_m) {
  const auto count = static_cast<Eigen::Index>(rig.used.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * count, 6 * count);
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(6 * count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const std::size_t v = rig.used[a];
    Matrix6d floor = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    add_floor(rig.views[v], rig.rig_from_sensor[v], floor, right);
    matrix.block<6, 6>(6 * a, 6 * a) += floor;
    vector.segment<6>(6 * a) += right;
    for (Eigen::Index b = 0; b < count; ++b) {
      if (a == b) continue;
      const std::size_t w = rig.used[b];
      const auto pair = overlap(rig, v, w, rig.rig_from_sensor[v], rig.rig_from_sensor[w], width_m, 1);
      matrix.block<6, 6>(6 * a, 6 * a) += pair.matrix;
      matrix.block<6, 6>(6 * b, 6 * b) += pair.matrix;
      matrix.block<6, 6>(6 * a, 6 * b) -= pair.matrix;
      matrix.block<6, 6>(6 * b, 6 * a) -= pair.matrix;
      vector.segment<6>(6 * a) += pair.vector;
      vector.segment<6>(6 * b) -= pair.vector;
    }
  }
  matrix.diagonal().array() += kGaugeDamping * matrix.trace();
  const Eigen::VectorXd solution = matrix.ldlt().solve(vector);
  for (Eigen::Index a = 0; a < count; ++a) {
    Isometry3d& pose = rig.rig_from_sensor[rig.used[a]];
    pose = exponential(solution.segment<6>(6 * a)) * pose;
  }
  return solution.cwiseAbs().maxCoeff();
}

// The rig as one rigid piece brought to the model; what it then costs, a view.
double align_rig(const FreeRig& rig, const ModelTarget& target, const std::vector<ModelGate>& gates, int iterations,
                 Isometry3d& model_from_rig) {
  double cost = 0;
  for (const ModelGate& gate : gates)
    for (int i = 0; i < iterations; ++i) {
      Matrix6d matrix = Matrix6d::Zero();
      Vector6d vector = Vector6d::Zero();
      cost = 0;
      for (const std::size_t v : rig.used) {
        const auto fit = model_equations(rig.views[v], target, model_from_rig * rig.rig_from_sensor[v], gate);
        matrix += fit.matrix, vector += fit.vector;
        cost += fit.points ? fit.cost / fit.points : 1;
      }
      if (matrix.trace() <= 0) return cost;
      const Vector6d step = solve_twist(matrix, vector);
      model_from_rig = exponential(step) * model_from_rig;
      if (negligible(step, kStillOverlap, kStillOverlap)) break;
    }
  return cost;
}

// The model's frame for the whole rig: the heading that fits best of all round, then the rest.
Isometry3d model_from_rig(const FreeRig& rig, const ModelTarget& target, const LossWidths& loss) {
  const std::vector<ModelGate> coarse{{0.20, 0.3, 200}, {0.08, 0.5, 300}};
  std::vector<Isometry3d> starts(kHeadings);
  std::vector<double> scores(kHeadings);
  tbb::parallel_for(0, kHeadings, [&](int k) {
    starts[k] = Isometry3d(Eigen::AngleAxisd(2 * M_PI * k / kHeadings, Vector3d::UnitY()));
    scores[k] = align_rig(rig, target, coarse, kRigIterations, starts[k]);
    for (const std::size_t v : rig.used)
      scores[k] +=
          contradicted_part(rig.views[v], target, rig.projectors[v], starts[k] * rig.rig_from_sensor[v], kBehind_m);
  });
  Isometry3d best = starts[std::min_element(scores.begin(), scores.end()) - scores.begin()];
  align_rig(
      rig, target,
      {{loss.wide_m, loss.normal_cosine}, {loss.middle_m, loss.normal_cosine}, {loss.narrow_m, loss.normal_cosine}},
      kRigIterations, best);
  return best;
}

// All views that stand on a floor and have a prior. One that then does not fit the model shows something else, or is
// tied to no other: the worst is left out and the others are done again, so that it leaves nothing in their poses.
std::vector<ViewAlignment> aligned_without(const std::vector<ViewPoints>& views, const ModelTarget& target,
                                           const ScanFreeParams& params) {
  FreeRig rig = free_rig(views);
  for (;;) {
    std::vector<ViewAlignment> alignments(views.size());
    if (rig.used.empty()) return alignments;
    for (const std::size_t v : rig.used) rig.rig_from_sensor[v] = stood_up(views[v]);
    find_headings(rig, params);
    for (const double width_m : {params.far_m, params.wide_m, params.narrow_m})
      for (int i = 0; i < params.iterations; ++i)
        if (overlap_step(rig, width_m) < kStillOverlap) break;
    const Isometry3d frame = model_from_rig(rig, target, params.loss);
    std::optional<std::size_t> worst;
    for (const std::size_t v : rig.used) {
      alignments[v] = measured_at(views[v], target, frame * rig.rig_from_sensor[v],
                                  {params.loss.middle_m, params.loss.normal_cosine});
      if (acceptable(views[v], target, alignments[v], params.acceptance)) continue;
      if (!worst || alignments[v].cost > alignments[*worst].cost) worst = v;
    }
    if (!worst) return alignments;
    rig.used.erase(std::find(rig.used.begin(), rig.used.end(), *worst));
  }
}

// The views about one another without the scan, which the thesis's last chapter wishes for: by the rig prior, each
// view's floor, and what any two share of mannequin, floor and room (Chen and Medioni, ICRA 1991; all at once: Pulli,
// 3DIM 1999). The scan's model then gives the rig, as one rigid piece, the frame of the stages after, and judges the
// views as it does for all variants; no view is moved by it alone. Boards that two sensors see at once would tie them
// as well, but a session's are each sensor's own. A view without floor or prior has no pose.
Registration scan_free(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                       const ExtractedViews& extracted, const ScanFreeParams& params) {
  check_registration_input(session, naked);
  const auto views = view_points(session, calibration, extracted, params.points);
  const ModelTarget target(naked);
  const auto alignments = aligned_without(views, target, params);
  Registration result = judged(views, target, alignments, params.acceptance);
  for (const ViewPoints& view : views)
    if (view.usable() && (!view.floor_plane || !view.world_from_sensor))
      result.problem[view.sensor] = view.floor_plane ? "no rig prior says where it stands, and no scan is used"
                                                     : "no floor was seen in it, and no scan is used";
  return result;
}

const Register::Variant scan_free_variant{"scan_free", scan_free};

}  // namespace
}  // namespace dressform
