#include "pipeline/registration/model_alignment.h"

#include <algorithm>
#include <cmath>

#include "scenes/statistics.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

constexpr double kModelSigma = 0.0015;  // of the model's own surface, metres
constexpr double kFloorSigma = 0.003;   // of a floor, which is never quite flat
constexpr int kLeastInliers = 40;       // for six unknowns with much to spare
constexpr double kReach = 1.5;          // of the loss's width: nearest points farther off are not looked for
constexpr double kLeastSigmas = 3;      // of the view's noise, that the loss is at least wide
constexpr double kLeastFloor_m = 0.02;  // width of the floor's loss: a floor is not as flat as a narrow loss
constexpr double kStill_rad = 2e-5, kStill_m = 3e-5;  // steps that move no point of a body by a tenth of a millimetre
constexpr double kFacing = 0.4;                       // cosine from which a part of the model faces the sensor

int stride_for(std::size_t count, int most) {
  return std::max<int>(1, static_cast<int>((count + most - 1) / std::max(1, most)));
}

void add_plane(ModelEquations& sum, const Vector3d& point, const Vector3d& normal, double residual, double weight) {
  Vector6d jacobian;
  jacobian << point.cross(normal), normal;
  sum.matrix.selfadjointView<Eigen::Lower>().rankUpdate(jacobian, weight);
  sum.vector -= weight * residual * jacobian;
}

double weight_of(double tukey, double sigma_m, double other_sigma_m) {
  return 1e-6 * tukey / (sigma_m * sigma_m + other_sigma_m * other_sigma_m);
}

}  // namespace

ModelTarget::ModelTarget(const BodyModel& naked)
    : query_(std::make_unique<MeshQuery>(naked.body)),
      normals_(dressform::vertex_normals(naked.body)),
      has_floor_(naked.floor_seen) {
  for (const auto& vertex : naked.body.vertices) top_m_ = std::max(top_m_, vertex.y());
}

bool ModelTarget::nearest(const MeshQuery& query, const Vector3d& point, double reach_m, Contact& contact) const {
  const auto found = query.closest(point, reach_m);
  if (found.triangle < 0) return false;
  const auto& corners = query.mesh().triangles[found.triangle];
  const auto& vertices = query.mesh().vertices;
  const Vector3d at =
      closest_barycentric(found.point, vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]);
  contact.point = found.point;
  contact.normal =
      (at[0] * normals_[corners[0]] + at[1] * normals_[corners[1]] + at[2] * normals_[corners[2]]).normalized();
  return true;
}

double loss_width_m(const ViewPoints& view, double asked_m) {
  return std::max(asked_m, kLeastSigmas * view.body_sigma_m);
}

ModelEquations model_equations(const ViewPoints& view, const ModelTarget& target, const Isometry3d& model_from_sensor,
                               const ModelGate& gate) {
  ModelEquations sum;
  const Eigen::Matrix3d& rotation = model_from_sensor.linear();
  const std::size_t body_stride = stride_for(view.body.size(), gate.most_points);
  const double width_m = loss_width_m(view, gate.distance_m);
  for (std::size_t k = 0; k < view.body.size(); k += body_stride) {
    const int i = view.body[k];
    const Vector3d point = model_from_sensor * view.map.points[i].cast<double>();
    ++sum.points;
    sum.cost += 1;
    ModelTarget::Contact contact;
    if (!target.body(point, kReach * width_m, contact)) continue;
    if (contact.normal.dot(rotation * view.map.normals[i].cast<double>()) < gate.normal_cosine) continue;
    const double residual = contact.normal.dot(point - contact.point);
    // The whole distance, not only that along the normal, says whether the two belong together.
    const Tukey tukey((point - contact.point).norm() / width_m);
    if (tukey.weight == 0) continue;
    sum.cost += tukey.loss - 1;
    add_plane(sum, point, contact.normal, residual, weight_of(tukey.weight, view.map.sigma_m[i], kModelSigma));
    sum.squared_residual_m2 += residual * residual;
    sum.expected_squared_m2 += view.map.sigma_m[i] * view.map.sigma_m[i] + kModelSigma * kModelSigma;
    ++sum.inliers;
  }
  if (!target.has_floor()) {
    sum.matrix = Matrix6d(sum.matrix.selfadjointView<Eigen::Lower>());
    return sum;
  }
  const std::size_t floor_stride = stride_for(view.floor.size(), std::max(1, gate.most_points / 3));
  for (std::size_t k = 0; k < view.floor.size(); k += floor_stride) {
    const int i = view.floor[k];
    const Vector3d point = model_from_sensor * view.map.points[i].cast<double>();
    const Tukey tukey(point.y() / std::max(gate.distance_m, kLeastFloor_m));
    if (tukey.weight == 0) continue;
    add_plane(sum, point, Vector3d::UnitY(), point.y(), weight_of(tukey.weight, view.map.sigma_m[i], kFloorSigma));
  }
  sum.matrix = Matrix6d(sum.matrix.selfadjointView<Eigen::Lower>());
  return sum;
}

void measure(const ModelEquations& sum, ViewAlignment& alignment) {
  alignment.inliers = sum.inliers;
  alignment.inlier_part = sum.points ? static_cast<double>(sum.inliers) / sum.points : 0;
  alignment.residual_rms_m = sum.inliers ? std::sqrt(sum.squared_residual_m2 / sum.inliers) : 0;
  alignment.expected_rms_m = sum.inliers ? std::sqrt(sum.expected_squared_m2 / sum.inliers) : 0;
}

ViewAlignment align_to_model(const ViewPoints& view, const ModelTarget& target, const Isometry3d& initial,
                             const std::vector<ModelGate>& gates, int iterations) {
  ViewAlignment result;
  result.model_from_sensor = initial;
  for (const ModelGate& gate : gates)
    for (int iteration = 0; iteration < iterations; ++iteration) {
      const ModelEquations sum = model_equations(view, target, result.model_from_sensor, gate);
      result.cost = sum.points ? sum.cost / sum.points : 1;
      measure(sum, result);
      result.valid = sum.inliers >= kLeastInliers;
      if (!result.valid) return result;
      const Vector6d twist = solve_twist(sum.matrix, sum.vector);
      result.model_from_sensor = exponential(twist) * result.model_from_sensor;
      if (negligible(twist, kStill_rad, kStill_m)) break;
    }
  return result;
}

double contradicted_part(const ViewPoints& view, const ModelTarget& target, const Projector& projector,
                         const Isometry3d& model_from_sensor, double tolerance_m) {
  constexpr int kMost = 3000;
  const auto& vertices = target.query().mesh().vertices;
  const Isometry3d sensor_from_model = model_from_sensor.inverse();
  const std::size_t stride = stride_for(vertices.size(), kMost);
  int facing = 0, contradicted = 0;
  for (std::size_t k = 0; k < vertices.size(); k += stride) {
    const Vector3d point = sensor_from_model * vertices[k];
    if ((sensor_from_model.linear() * target.vertex_normals()[k]).dot(point.normalized()) > -kFacing) continue;
    Vector2f pixel;
    if (!projector(point.cast<float>(), pixel)) continue;
    const int x = static_cast<int>(pixel.x() + 0.5f), y = static_cast<int>(pixel.y() + 0.5f);
    const float z = view.map.points[static_cast<std::size_t>(y) * view.map.camera.width + x].z();
    if (z == 0 || z < point.z() - tolerance_m) continue;
    ++facing;
    if (z > point.z() + tolerance_m) ++contradicted;
  }
  return facing > 0 ? static_cast<double>(contradicted) / facing : 1;
}

}  // namespace dressform
