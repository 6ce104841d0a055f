#pragma once
#include <vector>

#include "pipeline/imaging/depth_map.h"

namespace dressform {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Normal equations of one directed pair of depth maps, point to plane with projective association (Chen and Medioni,
// 1991; Blais and Levine, 1995). Twists are (rotation, translation) of the world frame; the same matrix serves both
// frames with opposite signs.
struct PairEquations {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d vector = Vector6d::Zero();
  double squared_residual_m2 = 0;  // sum over inliers, unweighted
  double cost = 0;                 // sum of the robust loss over all points that fell into the target's image
  int inliers = 0, visible = 0;
};

// How points of a pair are judged.
struct CorrespondenceRejector {
  double distance_m = 0.04;    // Tukey's constant, of the distance to the plane; beyond 1.5 times this there is no pair
  double normal_cosine = 0.8;  // least agreement of the normals
  int stride = 1;              // of the source's samples
};

PairEquations pair_equations(const DepthMap& source, const std::vector<int>& samples, const DepthMap& target,
                             const Projector& target_projector, const Isometry3d& world_from_source,
                             const Isometry3d& world_from_target, const CorrespondenceRejector& gate);

// Whether a step is smaller than both, and iteration may end.
bool negligible(const Vector6d& twist, double rotation_rad, double translation_m);

// exp of a twist (rotation vector, translation) as a rigid motion.
Isometry3d exponential(const Vector6d& twist);

// A rigid motion as a rotation vector and what it does to a point, and back. Unlike exp's, the translation does not
// depend on how far the frame's origin is.
Vector6d motion_at(const Isometry3d& motion, const Vector3d& centre);
Isometry3d motion_about(const Vector6d& step, const Vector3d& centre);

// Solution of damped normal equations: a twist.
Vector6d solve_twist(Matrix6d matrix, const Vector6d& vector);

}  // namespace dressform
