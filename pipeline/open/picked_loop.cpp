#include "pipeline/open/picked_loop.h"

#include <algorithm>
#include <cmath>

#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kSame_m = 1e-6;  // points nearer to one another are one
constexpr double kMerge = 0.5;    // of the usual spacing: two sensors' points of one place
constexpr double kGap = 2.5;      // of the usual spacing: here nobody picked

// Coordinates about a loop: the plane that its points lie on best, and in it the centre of the circle through them
// (Kasa, 1976), which stays in the middle where only an arc was seen.
struct LoopFrame {
  Vector3d centre = Vector3d::Zero(), right = Vector3d::UnitX(), ahead = Vector3d::UnitZ(), axis = Vector3d::UnitY();

  explicit LoopFrame(const std::vector<Vector3d>& points) {
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& p : points) mean += p / static_cast<double>(points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vector3d& p : points) spread += (p - mean) * (p - mean).transpose();
    const SymmetricEigen principal = symmetric_eigen(spread);
    axis = principal.vectors.col(0);
    right = principal.vectors.col(2);
    ahead = axis.cross(right);
    Eigen::MatrixX3d circle(points.size(), 3);
    Eigen::VectorXd squares(points.size());
    for (Eigen::Index i = 0; i < circle.rows(); ++i) {
      const Vector3d d = points[i] - mean;
      circle.row(i) << 2 * d.dot(right), 2 * d.dot(ahead), 1;
      squares[i] = d.dot(right) * d.dot(right) + d.dot(ahead) * d.dot(ahead);
    }
    const Vector3d solution = solve_least_squares(circle, squares);
    centre = mean + solution.x() * right + solution.y() * ahead;
  }

  struct Cylinder {
    double angle, radius, height;
  };
  Cylinder of(const Vector3d& point) const {
    const Vector3d d = point - centre;
    const double x = d.dot(right), y = d.dot(ahead);
    return {std::atan2(y, x), std::hypot(x, y), d.dot(axis)};
  }
  Vector3d at(const Cylinder& c) const {
    return centre + c.radius * (std::cos(c.angle) * right + std::sin(c.angle) * ahead) + c.height * axis;
  }
};

std::vector<Vector3d> without_repeats(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> result;
  for (const Vector3d& p : points)
    if (result.empty() || (p - result.back()).norm() > kSame_m) result.push_back(p);
  while (result.size() > 1 && (result.front() - result.back()).norm() <= kSame_m) result.pop_back();
  return result;
}

double usual_spacing_m(const std::vector<const PickedPoints*>& parts) {
  std::vector<double> steps;
  for (const PickedPoints* part : parts)
    for (std::size_t i = 1; i < part->points.size(); ++i)
      steps.push_back((part->points[i] - part->points[i - 1]).norm());
  return median_or(std::move(steps), 0.0);
}

// Runs of points closer than `least_m` to the first of the run, each as its mean.
std::vector<Vector3d> thinned(const std::vector<Vector3d>& points, double least_m) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    Vector3d sum = Vector3d::Zero();
    while (end < points.size() && (points[end] - points[i]).norm() <= least_m) sum += points[end++];
    result.push_back(sum / static_cast<double>(end - i));
    i = end;
  }
  while (result.size() > 1 && (result.front() - result.back()).norm() <= least_m) result.pop_back();
  return result;
}

std::vector<Vector3d> with_gaps_bridged(const std::vector<Vector3d>& loop, const LoopFrame& frame, double spacing_m) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    result.push_back(loop[i]);
    const auto from = frame.of(loop[i]), to = frame.of(loop[(i + 1) % loop.size()]);
    double turn = to.angle - from.angle;
    if (turn <= 0) turn += 2 * M_PI;
    const double arc_m = turn * (from.radius + to.radius) / 2;
    if (spacing_m <= 0 || arc_m < kGap * spacing_m) continue;
    const int parts = static_cast<int>(std::lround(arc_m / spacing_m));
    for (int k = 1; k < parts; ++k) {
      const double part = static_cast<double>(k) / parts;
      result.push_back(frame.at({from.angle + part * turn, from.radius + part * (to.radius - from.radius),
                                 from.height + part * (to.height - from.height)}));
    }
  }
  return result;
}

}  // namespace

std::vector<Vector3d> picked_loop(const std::vector<PickedPoints>& parts) {
  std::vector<const PickedPoints*> used;
  std::vector<Vector3d> all;
  for (const PickedPoints& part : parts) {
    if (part.frame != "model" || part.points.empty()) continue;
    used.push_back(&part);
    all.insert(all.end(), part.points.begin(), part.points.end());
  }
  if (used.size() < 2 || all.size() < 3) return without_repeats(all);
  const LoopFrame frame(all);
  std::stable_sort(all.begin(), all.end(),
                   [&](const Vector3d& a, const Vector3d& b) { return frame.of(a).angle < frame.of(b).angle; });
  const double spacing_m = usual_spacing_m(used);
  return with_gaps_bridged(without_repeats(thinned(all, kMerge * spacing_m)), frame, spacing_m);
}

Vector3d doubled_area(const std::vector<Vector3d>& loop) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (loop[i] - loop.front()).cross(loop[(i + 1) % loop.size()] - loop.front());
  return sum;
}

double enclosed_area_m2(const std::vector<Vector3d>& loop) { return doubled_area(loop).norm() / 2; }

}  // namespace dressform
