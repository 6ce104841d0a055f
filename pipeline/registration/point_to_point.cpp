#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/registration/each_view.h"
#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

struct PointToPointParams {
  EachViewOptions views{2000, 50};
};

template <class V>
void fields(V& v, PointToPointParams& p) {
  each_view_fields(v, p.views, 1000);
}

constexpr double kReach = 1.5;  // of the loss's width: nearest points farther off are not looked for
constexpr int kLeastPairs = 40;
constexpr double kStill_rad = 5e-6, kStill_m = 1e-5;  // steps that a hundred of their like make no millimetre of
constexpr double kLeastFloor_m = 0.02;                // a floor is not as flat as a narrow loss

// Weighted pairs of points, reduced to what the best rigid motion needs.
struct Pairs {
  double weight = 0, loss = 0;  // loss: sum of the robust losses of `points` points
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();  // sum of weight * from * to'
  int count = 0, points = 0;

  void add(const Vector3d& a, const Vector3d& b, double w) {
    weight += w;
    from += w * a;
    to += w * b;
    product += w * a * b.transpose();
    ++count;
  }
  double cost() const { return points ? loss / points : 1; }
};

// The rigid motion of least weighted squares (Arun, Huang and Blostein, PAMI 1987; Besl and McKay use Horn's equivalent
// quaternions).
Isometry3d best_motion(const Pairs& pairs) {
  const Vector3d from = pairs.from / pairs.weight, to = pairs.to / pairs.weight;
  const Eigen::Matrix3d spread = pairs.product - pairs.weight * from * to.transpose();
  const Eigen::Matrix3d turn = nearest_rotation(spread.transpose());
  Isometry3d motion = Isometry3d::Identity();
  motion.linear() = turn;
  motion.translation() = to - turn * from;
  return motion;
}

// Every point of the view with the nearest point of the model, the floor among it; both in the model's frame.
Pairs closest_pairs(const ViewPoints& view, const ModelTarget& target, const Isometry3d& model_from_sensor,
                    const ModelGate& gate) {
  Pairs pairs;
  const double width_m = loss_width_m(view, gate.distance_m);
  for (const int i : view.body) {
    const Vector3d point = model_from_sensor * view.map.points[i].cast<double>();
    ++pairs.points;
    pairs.loss += 1;
    ModelTarget::Contact contact;
    if (!target.body(point, kReach * width_m, contact)) continue;
    if (contact.normal.dot(model_from_sensor.linear() * view.map.normals[i].cast<double>()) < gate.normal_cosine)
      continue;
    const Tukey tukey((point - contact.point).norm() / width_m);
    if (tukey.weight == 0) continue;
    pairs.loss += tukey.loss - 1;
    pairs.add(point, contact.point, tukey.weight);
  }
  if (!target.has_floor()) return pairs;
  for (const int i : view.floor) {
    const Vector3d point = model_from_sensor * view.map.points[i].cast<double>();
    const Tukey tukey(point.y() / std::max(gate.distance_m, kLeastFloor_m));
    if (tukey.weight > 0) pairs.add(point, {point.x(), 0, point.z()}, tukey.weight);
  }
  return pairs;
}

// Besl and McKay's acceleration: while steps keep their direction, the error along the path is followed by a line and a
// parabola through its last three values, and the pose goes on to where they end.
class Acceleration {
 public:
  // A step (about the body, rotations in radians of a lever of a metre) and the error before it. How far to go on, as
  // a part of the step; 0: not.
  double beyond(const Vector6d& step, double error) {
    const bool straight = steps_ >= 2 && aligned(step, step_) && aligned(step_, before_);
    const double part = straight ? extrapolated(step, error) : 0;
    before_ = step_;
    step_ = step;
    steps_ = part > 0 ? 0 : steps_ + 1;  // a jump says nothing of the path's direction
    errors_ = {errors_[1], error};
    return part;
  }

 private:
  static bool aligned(const Vector6d& a, const Vector6d& b) {
    constexpr double kCosine = 0.985;  // 10 degrees, as in the paper
    return a.dot(b) > kCosine * a.norm() * b.norm();
  }
  double extrapolated(const Vector6d& step, double error) const {
    constexpr double kFarthest = 25;                                                  // steps, as in the paper
    const double length = step.norm(), v1 = -step_.norm(), v2 = v1 - before_.norm();  // arc lengths; now: 0
    const double d0 = error, d1 = errors_[1], d2 = errors_[0];
    const double slope = (d1 - d0) / v1;                        // of the line through the last two
    const double curve = ((d2 - d0) / v2 - slope) / (v2 - v1);  // of the parabola through three
    const double tilt = slope - curve * v1;                     // of the parabola at 0
    const double line = slope < 0 ? -d0 / slope : -1, parabola = curve > 0 ? -tilt / (2 * curve) : -1;
    const double farthest = kFarthest * length;
    double to = 0;
    if (parabola > 0 && (line <= 0 || parabola < line))
      to = parabola;
    else if (line > 0)
      to = line;
    return std::max(0.0, std::min(to, farthest) / length - 1);  // the step itself is taken anyway
  }
  Vector6d step_ = Vector6d::Zero(), before_ = Vector6d::Zero();  // the last one and the one before it
  int steps_ = 0;                                                 // since the last jump
  std::array<double, 2> errors_{0, 0};
};

ViewAlignment align_points(const ViewPoints& view, const ModelTarget& target, const Isometry3d& initial,
                           const std::vector<ModelGate>& gates, int iterations) {
  ViewAlignment result;
  result.model_from_sensor = initial;
  for (const ModelGate& gate : gates) {
    Acceleration acceleration;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      const Pairs pairs = closest_pairs(view, target, result.model_from_sensor, gate);
      result.valid = pairs.count >= kLeastPairs;
      if (!result.valid) return result;
      const Vector3d centre = pairs.to / pairs.weight;
      const Vector6d step = motion_at(best_motion(pairs), centre);
      if (negligible(step, kStill_rad, kStill_m)) break;
      const double beyond = acceleration.beyond(step, pairs.cost());
      result.model_from_sensor = motion_about((1 + beyond) * step, centre) * result.model_from_sensor;
    }
  }
  const ModelEquations fit = model_equations(view, target, result.model_from_sensor, gates.back());
  measure(fit, result);
  result.cost = fit.points ? fit.cost / fit.points : 1;
  return result;
}

// Every view by itself against the model: each point goes to the nearest one of the model, and the rigid motion of
// least squares takes all there (Besl and McKay, "A method for registration of 3-D shapes", PAMI 1992), with a loss
// that narrows. A baseline: along a surface nothing holds a view, so that it creeps where planes would let it slide.
Registration point_to_point(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                            const ExtractedViews& extracted, const PointToPointParams& params) {
  return register_each_view(session, calibration, naked, extracted, params.views, align_points);
}

const Register::Variant point_to_point_variant{"point_to_point", point_to_point};

}  // namespace
}  // namespace dressform
