#include "pipeline/fit/rbf_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

namespace dressform {
namespace {

constexpr double kMerge_m = 1e-3;

struct Pairs {
  std::vector<Vector3d> centers, displacements;
};

// The mean of all pairs whose controls share a cell of a millimetre.
Pairs merged(const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets) {
  std::map<std::tuple<long, long, long>, std::size_t> cells;
  Pairs pairs;
  std::vector<int> counts;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const Vector3d cell = (controls[i] / kMerge_m).array().floor();
    const auto key = std::make_tuple(std::lround(cell.x()), std::lround(cell.y()), std::lround(cell.z()));
    const auto [at, fresh] = cells.emplace(key, pairs.centers.size());
    if (fresh) {
      pairs.centers.push_back(controls[i]);
      pairs.displacements.push_back(targets[i] - controls[i]);
      counts.push_back(1);
    } else {
      pairs.displacements[at->second] += targets[i] - controls[i];
      ++counts[at->second];
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i) pairs.displacements[i] /= counts[i];
  return pairs;
}

// Conditionally positive definite: -r, r^3 and r^2 log r; positive definite: those that fall off.
double basis(RbfField::Kernel kernel, double r_squared, double radius_m) {
  if (kernel == RbfField::Kernel::gaussian) return std::exp(-r_squared / (radius_m * radius_m));
  if (kernel == RbfField::Kernel::wendland) {
    const double q = std::sqrt(r_squared) / radius_m, rest = std::max(0.0, 1 - q);
    return rest * rest * rest * rest * (4 * q + 1);
  }
  if (kernel == RbfField::Kernel::thin_plate) return r_squared > 0 ? 0.5 * r_squared * std::log(r_squared) : 0;
  const double r = std::sqrt(r_squared);
  return kernel == RbfField::Kernel::linear ? -r : r_squared * r;
}

}  // namespace

RbfField::RbfField(const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets, Kernel kernel,
                   double smoothing, double radius_m)
    : kernel_(kernel), radius_m_(radius_m) {
  if (controls.size() != targets.size()) throw std::invalid_argument("RbfField: as many targets as controls");
  const Pairs pairs = merged(controls, targets);
  if (pairs.centers.empty()) return;
  for (const auto& center : pairs.centers) origin_ += center / static_cast<double>(pairs.centers.size());
  centers_ = pairs.centers;
  weights_.assign(centers_.size(), Vector3d::Zero());
  if (centers_.size() < 4) {
    for (const auto& d : pairs.displacements) affine_.col(3) += d / static_cast<double>(centers_.size());
  } else {
    solve(pairs.displacements, smoothing);
  }
  for (std::size_t i = 0; i < centers_.size(); ++i)
    largest_residual_m_ =
        std::max(largest_residual_m_, ((*this)(centers_[i]) - centers_[i] - pairs.displacements[i]).norm());
}

void RbfField::solve(const std::vector<Vector3d>& displacements, double smoothing) {
  const int n = static_cast<int>(centers_.size());
  Eigen::MatrixXd polynomial(n, 4), right = Eigen::MatrixXd::Zero(n + 4, 3);
  for (int i = 0; i < n; ++i) {
    polynomial.row(i) << (centers_[i] - origin_).transpose(), 1;
    right.row(i) = displacements[i];
  }
  if (polynomial.colPivHouseholderQr().rank() < 4) {  // a plane or line: the system would be singular
    affine_ = polynomial.completeOrthogonalDecomposition().solve(right.topRows(n)).transpose();
    return;
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
  tbb::parallel_for(0, n, [&](int i) {
    for (int j = 0; j < n; ++j) system(j, i) = basis(kernel_, (centers_[i] - centers_[j]).squaredNorm(), radius_m_);
    system(i, i) += smoothing;
  });
  system.block(0, n, n, 4) = polynomial;
  system.block(n, 0, 4, n) = polynomial.transpose();
  // LU, because LDLT goes wrong on this indefinite system without saying so.
  const Eigen::MatrixXd solution = system.partialPivLu().solve(right);
  for (int i = 0; i < n; ++i) weights_[i] = solution.row(i);
  affine_ = solution.bottomRows(4).transpose();
}

Vector3d RbfField::operator()(const Vector3d& point) const {
  Vector3d moved = point + affine_.leftCols<3>() * (point - origin_) + affine_.col(3);
  for (std::size_t i = 0; i < centers_.size(); ++i)
    moved += basis(kernel_, (point - centers_[i]).squaredNorm(), radius_m_) * weights_[i];
  return moved;
}

std::vector<Vector3d> RbfField::operator()(const std::vector<Vector3d>& points) const {
  std::vector<Vector3d> moved(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) moved[i] = (*this)(points[i]);
  });
  return moved;
}

}  // namespace dressform
