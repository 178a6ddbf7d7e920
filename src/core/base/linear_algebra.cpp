// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/linear_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace whipple {

using Eigen::MatrixXd;

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

MatrixXd solve_symmetric(const MatrixXd& a, const MatrixXd& b) { return a.ldlt().solve(b); }

MatrixXd inverse_of_symmetric(const MatrixXd& a) {
  return solve_symmetric(a, MatrixXd::Identity(a.rows(), a.cols()));
}

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

MatrixXd least_squares_solution(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Cholesky::Cholesky(const MatrixXd& matrix) {
  const Eigen::LLT<MatrixXd> factors(matrix);
  lower_ = factors.matrixL();
  positive_ = factors.info() == Eigen::Success;
}

MatrixXd Cholesky::whitened(const MatrixXd& b) const {
  return lower_.triangularView<Eigen::Lower>().solve(b);
}

MatrixXd Cholesky::solve(const MatrixXd& b) const {
  return lower_.triangularView<Eigen::Lower>().adjoint().solve(whitened(b));
}

}  // namespace whipple
