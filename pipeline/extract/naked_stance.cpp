#include "pipeline/extract/naked_stance.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr std::size_t kLeastPoints = 100;
constexpr std::size_t kCoarsePoints = 300, kFinePoints = 500;
constexpr int kStarts = 16, kCoarseRounds = 8, kKept = 3, kFineRounds = 20;
constexpr double kBehindSurface_m = 0.1;  // of a body's axis, behind the middle of what one view sees of it
constexpr double kFarthest_m = 0.12;      // clothes and stands are no farther reason to move

std::vector<Vector3d> evenly(const std::vector<Vector3d>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Vector3d> result;
  for (std::size_t k = 0; k < most; ++k) result.push_back(all[k * all.size() / most]);
  return result;
}

// Rows: two horizontal directions and up between them, a right-handed frame with y up; height by the floor.
Isometry3d upright_frame(const Vector3d& up, const std::optional<Eigen::Vector4d>& floor) {
  const Vector3d y = floor ? Vector3d(floor->head<3>()) : up;
  const Vector3d side = std::abs(y.z()) < 0.9 ? Vector3d(0, 0, 1) : Vector3d(1, 0, 0);
  const Vector3d x = y.cross(side).normalized();
  Isometry3d frame = Isometry3d::Identity();
  frame.linear() << x.transpose(), y.transpose(), x.cross(y).transpose();
  if (floor) frame.translation().y() = (*floor)[3];
  return frame;
}

Vector3d mean_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// One step towards the closest points; the mean distance before it, cut off at kFarthest_m.
double step_upright(const std::vector<Vector3d>& points, const MeshQuery& model, bool lift, Isometry3d& model_from) {
  double cost = 0, sine = 0, cosine = 0;
  std::vector<std::pair<Vector3d, Vector3d>> pairs;
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  for (const Vector3d& point : points) {
    const Vector3d p = model_from * point;
    const auto found = model.closest(p, kFarthest_m);
    cost += found.triangle < 0 ? kFarthest_m : found.distance;
    if (found.triangle < 0) continue;
    pairs.emplace_back(p, found.point);
    from += p, to += found.point;
  }
  cost /= static_cast<double>(points.size());
  if (pairs.size() < 3) return cost;
  from /= static_cast<double>(pairs.size());
  to /= static_cast<double>(pairs.size());
  for (const auto& [p, q] : pairs) {
    const Vector3d a = p - from, b = q - to;
    cosine += a.x() * b.x() + a.z() * b.z();
    sine += a.z() * b.x() - a.x() * b.z();  // a turn about y takes z to x
  }
  Isometry3d step(Eigen::AngleAxisd(std::atan2(sine, cosine), Vector3d::UnitY()));
  if (!lift) from.y() = to.y() = 0;
  step.translation() = to - step.linear() * from;
  model_from = step * model_from;
  return cost;
}

struct Stance {
  Isometry3d model_from_sensor;
  double cost = 0;
};

void settle(Stance& stance, const std::vector<Vector3d>& points, const MeshQuery& model, bool lift, int rounds) {
  for (int k = 0; k < rounds; ++k) stance.cost = step_upright(points, model, lift, stance.model_from_sensor);
}

}  // namespace

std::optional<Isometry3d> model_stance(const std::vector<Vector3d>& points, const Vector3d& up,
                                       const std::optional<Eigen::Vector4d>& floor, const MeshQuery& model) {
  if (points.size() < kLeastPoints || model.mesh().triangles.empty()) return {};
  const Isometry3d upright = upright_frame(up, floor);
  const Vector3d middle = mean_of(points), line = upright.linear() * middle;
  Vector3d place = upright * middle + kBehindSurface_m * Vector3d(line.x(), 0, line.z()).normalized();
  // Without a floor, the middle of what is seen is at the middle of the model.
  place.y() = floor ? 0 : place.y() - mean_of(model.mesh().vertices).y();
  const auto coarse = evenly(points, kCoarsePoints), fine = evenly(points, kFinePoints);
  std::vector<Stance> stances;
  for (int k = 0; k < kStarts; ++k) {
    const Eigen::AngleAxisd turn(2 * M_PI * k / kStarts, Vector3d::UnitY());
    stances.push_back({turn * Eigen::Translation3d(-place) * upright, 0});
    settle(stances.back(), coarse, model, !floor, kCoarseRounds);
  }
  const auto cheaper = [](const Stance& a, const Stance& b) { return a.cost < b.cost; };
  std::stable_sort(stances.begin(), stances.end(), cheaper);
  stances.resize(kKept);
  for (Stance& stance : stances) settle(stance, fine, model, !floor, kFineRounds);
  return std::min_element(stances.begin(), stances.end(), cheaper)->model_from_sensor;
}

}  // namespace dressform
