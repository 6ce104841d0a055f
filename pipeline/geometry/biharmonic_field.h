#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// The function of space through values at points that bends least: radial basis functions r, the biharmonic spline of
// three dimensions, with a linear part (Carr et al., SIGGRAPH 2001). Dense: for a few thousand centres.
class BiharmonicField {
 public:
  // Metres; values of any unit. `smoothing_m` lets the function miss the values a little for smoothness (Carr et al.,
  // "Smooth surface reconstruction from noisy range data", GRAPHITE 2003); 0 interpolates. No two centres may be the
  // same, and at least four must span space: throws std::invalid_argument where they do not, or the lists differ in
  // length.
  BiharmonicField(std::vector<Vector3d> centres, const std::vector<double>& values, double smoothing_m);

  double operator()(const Vector3d& point) const;
  std::vector<double> operator()(const std::vector<Vector3d>& points) const;  // on all threads

 private:
  std::vector<Vector3d> centres_;
  std::vector<double> weights_;
  Vector3d origin_ = Vector3d::Zero();
  Eigen::Vector4d linear_ = Eigen::Vector4d::Zero();  // of (point - origin, 1)
};

}  // namespace dressform
