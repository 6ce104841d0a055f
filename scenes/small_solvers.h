#pragma once
#include <Eigen/Core>

namespace dressform {

// Eigen's factorisations of small matrices, compiled once: written out where they are used, each costs the compiler
// three to eight seconds.

// The smallest rotation that takes the direction of `from` to that of `to`; neither may be zero.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

// The rotation R that makes trace(R^T M) largest: the nearest to M in the Frobenius norm (Kabsch, 1976).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

// Eigenvalues of a symmetric matrix in ascending order, eigenvectors as columns in the same order.
struct SymmetricEigen {
  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix);

// x of matrix * x = right, matrix symmetric and positive semidefinite (LDL^T with pivoting); its lower half is read.
Eigen::VectorXd solve_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                const Eigen::Ref<const Eigen::VectorXd>& right);

// x that makes |matrix * x - right| least (QR with column pivoting).
Eigen::VectorXd solve_least_squares(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                    const Eigen::Ref<const Eigen::VectorXd>& right);

}  // namespace dressform
