#include "pipeline/geometry/biharmonic_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace dressform {
namespace {

constexpr std::size_t kPointsATask = 64;  // evaluated by one thread at a time

}  // namespace

BiharmonicField::BiharmonicField(std::vector<Vector3d> centres, const std::vector<double>& values, double smoothing_m)
    : centres_(std::move(centres)) {
  if (centres_.size() != values.size()) throw std::invalid_argument("BiharmonicField: one value is needed a centre");
  const auto n = static_cast<Eigen::Index>(centres_.size());
  for (const Vector3d& centre : centres_) origin_ += centre / static_cast<double>(n);
  Eigen::MatrixXd polynomial(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) polynomial.row(i) << (centres_[i] - origin_).transpose(), 1;
  if (n < 4 || polynomial.colPivHouseholderQr().rank() < 4)
    throw std::invalid_argument("BiharmonicField: the centres must span space");
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
  tbb::parallel_for(Eigen::Index{0}, n, [&](Eigen::Index i) {
    for (Eigen::Index j = 0; j < n; ++j) system(j, i) = -(centres_[i] - centres_[j]).norm();
    system(i, i) += smoothing_m;
  });
  system.block(0, n, n, 4) = polynomial;
  system.block(n, 0, 4, n) = polynomial.transpose();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 4);
  for (Eigen::Index i = 0; i < n; ++i) right[i] = values[i];
  // LU, because LDLT goes wrong on this indefinite system without saying so.
  const Eigen::VectorXd solution = system.partialPivLu().solve(right);
  weights_.assign(solution.data(), solution.data() + n);
  linear_ = solution.tail<4>();
}

double BiharmonicField::operator()(const Vector3d& point) const {
  double sum = linear_.head<3>().dot(point - origin_) + linear_[3];
  for (std::size_t i = 0; i < centres_.size(); ++i) sum -= (point - centres_[i]).norm() * weights_[i];
  return sum;
}

std::vector<double> BiharmonicField::operator()(const std::vector<Vector3d>& points) const {
  std::vector<double> values(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kPointsATask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) values[i] = (*this)(points[i]);
  });
  return values;
}

}  // namespace dressform
