#include "pipeline/fit/displacement_lattice.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dressform {
namespace {

constexpr double kStay = 1e-9;  // weight of no displacement: for nodes that nothing else holds

// Weights of the nodes from `first` on at a place on one axis, in steps.
struct AxisWeights {
  int first = 0, count = 0;
  std::array<double, 4> weight{0, 0, 0, 0};
};

AxisWeights linear_weights(double at, int size) {
  const double held = std::clamp(at, 0.0, static_cast<double>(size - 1));
  const int first = std::min(static_cast<int>(std::floor(held)), size - 2);
  const double t = held - first;
  return {first, 2, {1 - t, t, 0, 0}};
}

// Uniform cubic B-splines; the first and last node lie one step outside the box.
AxisWeights cubic_weights(double at, int size) {
  const double held = std::clamp(at, 0.0, static_cast<double>(size - 3));
  const int first = std::min(static_cast<int>(std::floor(held)), size - 4);
  const double t = held - first, s = 1 - t;
  return {first,
          4,
          {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6}};
}

}  // namespace

DisplacementLattice::DisplacementLattice(const Box& box, double step_m, Between between, double stiffness,
                                         const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets)
    : origin_(box.low), step_m_(step_m), between_(between) {
  if (controls.size() != targets.size())
    throw std::invalid_argument("DisplacementLattice: as many targets as controls");
  if (!(step_m > 0)) throw std::invalid_argument("DisplacementLattice: the step must be positive");
  const int beside = between == Between::cubic ? 2 : 0;
  for (int k = 0; k < 3; ++k)
    size_[k] = std::max(2, 1 + static_cast<int>(std::ceil((box.high[k] - box.low[k]) / step_m))) + beside;
  const int count = size_[0] * size_[1] * size_[2];
  displacements_.assign(static_cast<std::size_t>(count), Vector3d::Zero());
  if (controls.empty()) return;

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3);
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const Weights at = weights_at(controls[i]);
    for (std::size_t a = 0; a < at.nodes.size(); ++a) {
      right.row(at.nodes[a]) += at.weights[a] * (targets[i] - controls[i]).transpose();
      for (std::size_t b = 0; b < at.nodes.size(); ++b)
        entries.emplace_back(at.nodes[a], at.nodes[b], at.weights[a] * at.weights[b]);
    }
  }
  const std::array<int, 3> stride{1, size_[0], size_[0] * size_[1]};
  constexpr std::array<double, 3> kSecond{1, -2, 1};
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x) {
        const std::array<int, 3> place{x, y, z};
        entries.emplace_back(node(x, y, z), node(x, y, z), kStay);
        for (int axis = 0; axis < 3; ++axis) {
          if (place[axis] == 0 || place[axis] == size_[axis] - 1) continue;
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
              entries.emplace_back(node(x, y, z) + (a - 1) * stride[axis], node(x, y, z) + (b - 1) * stride[axis],
                                   stiffness * kSecond[a] * kSecond[b]);
        }
      }
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
  const Eigen::MatrixXd solution = solver.solve(right);
  for (int i = 0; i < count; ++i) displacements_[i] = solution.row(i);
}

DisplacementLattice::Weights DisplacementLattice::weights_at(const Vector3d& point) const {
  std::array<AxisWeights, 3> axes;
  for (int k = 0; k < 3; ++k) {
    const double at = (point[k] - origin_[k]) / step_m_;
    axes[k] = between_ == Between::cubic ? cubic_weights(at, size_[k]) : linear_weights(at, size_[k]);
  }
  Weights result;
  for (int z = 0; z < axes[2].count; ++z)
    for (int y = 0; y < axes[1].count; ++y)
      for (int x = 0; x < axes[0].count; ++x) {
        result.nodes.push_back(node(axes[0].first + x, axes[1].first + y, axes[2].first + z));
        result.weights.push_back(axes[0].weight[x] * axes[1].weight[y] * axes[2].weight[z]);
      }
  return result;
}

Vector3d DisplacementLattice::operator()(const Vector3d& point) const {
  const Weights at = weights_at(point);
  Vector3d moved = point;
  for (std::size_t i = 0; i < at.nodes.size(); ++i) moved += at.weights[i] * displacements_[at.nodes[i]];
  return moved;
}

DisplacementLattice::Box box_round(const Mesh& body, double margin_m) {
  DisplacementLattice::Box box{body.vertices.front(), body.vertices.front()};
  for (const Vector3d& v : body.vertices) box.low = box.low.cwiseMin(v), box.high = box.high.cwiseMax(v);
  box.low.array() -= margin_m;
  box.high.array() += margin_m;
  return box;
}

}  // namespace dressform
