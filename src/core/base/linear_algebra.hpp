// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

/// Solutions of small dense problems, compiled once: Eigen's decompositions are large templates. Kernels that solve
/// such a problem for each point or node use Eigen itself.
namespace whipple {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< in ascending order
  Eigen::MatrixXd vectors;  ///< columns, of length 1
};

/// Computes eigenvalues and eigenvectors of a symmetric matrix.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// Solves A X = B for a symmetric positive matrix (LDL^T with pivoting).
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Computes the inverse of a symmetric positive matrix by its LDL^T factors.
Eigen::MatrixXd inverse_of_symmetric(const Eigen::MatrixXd& a);

/// Computes the inverse of a square matrix by LU factors with partial pivoting.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);

/// Computes the X that minimises |A X - B| (QR with column pivoting).
Eigen::MatrixXd least_squares_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Holds the Cholesky factors A = L L^T of a symmetric positive matrix.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const Eigen::MatrixXd& matrix);

  /// Returns whether the matrix was positive.
  [[nodiscard]] bool is_positive() const { return positive_; }
  [[nodiscard]] const Eigen::MatrixXd& lower() const { return lower_; }
  /// Returns L^-1 B.
  [[nodiscard]] Eigen::MatrixXd whitened(const Eigen::MatrixXd& b) const;
  /// Returns A^-1 B.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  Eigen::MatrixXd lower_;
  bool positive_ = true;
};

}  // namespace whipple
