#include "scenes/small_solvers.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace dressform {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

TEST(SmallSolvers, SmallestRotationEvenOfOppositeDirections) {
  const Vector3d up(0, 2, 0), aslant(1, 1, 0);
  EXPECT_LT((rotation_between(up, aslant) * up - Vector3d(std::sqrt(2), std::sqrt(2), 0)).norm(), 1e-12);
  const Matrix3d over = rotation_between(up, -up);
  EXPECT_LT((over * up + up).norm(), 1e-9);
  EXPECT_NEAR(over.determinant(), 1, 1e-9);
}

TEST(SmallSolvers, NearestRotationOfAStretchedOneAndOfAMirror) {
  const Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Matrix3d stretch = Vector3d(1.1, 0.9, 1.3).asDiagonal();
  EXPECT_LT((nearest_rotation(turn * stretch) - turn).norm(), 1e-12);
  const Matrix3d mirror = Vector3d(1, 1, -0.5).asDiagonal();
  EXPECT_NEAR(nearest_rotation(mirror).determinant(), 1, 1e-12);
  EXPECT_LT((nearest_rotation(mirror) - Matrix3d::Identity()).norm(), 1e-12);  // the least of the three gives way
}

TEST(SmallSolvers, EigenvaluesAscend) {
  const Matrix3d axes = Eigen::AngleAxisd(0.7, Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  const auto found = symmetric_eigen(axes * Vector3d(5, 1, 3).asDiagonal() * axes.transpose());
  EXPECT_LT((found.values - Vector3d(1, 3, 5)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(found.vectors.col(0).dot(axes.col(1))), 1, 1e-12);
}

TEST(SmallSolvers, SolvesWhatItIsGiven) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity() * 3;
  matrix(1, 0) = matrix(0, 1) = 1;
  const Eigen::Vector4d x(1, -2, 3, 4);
  EXPECT_LT((solve_symmetric(matrix, matrix * x) - x).norm(), 1e-12);
  Eigen::MatrixXd line(3, 2);
  line << 1, 0, 1, 1, 1, 2;
  EXPECT_LT((solve_least_squares(line, Vector3d(1, 3, 5)) - Eigen::Vector2d(1, 2)).norm(), 1e-12);
}

}  // namespace
}  // namespace dressform
