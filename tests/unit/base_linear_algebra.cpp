// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "src/core/base/linear_algebra.hpp"

namespace whipple {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const MatrixXd& symmetric() {
  static const MatrixXd matrix = (MatrixXd(3, 3) << 4, 1, 0.5, 1, 3, -0.2, 0.5, -0.2, 2).finished();
  return matrix;
}

TEST(LinearAlgebra, EigenvectorsAreTurnedIntoMultiplesOfThemselves) {
  const SymmetricEigen eigen = symmetric_eigen(symmetric());
  const MatrixXd residual = symmetric() * eigen.vectors - eigen.vectors * eigen.values.asDiagonal();
  EXPECT_LT(residual.norm(), 1e-14);
  EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  EXPECT_LT(eigen.values[0], eigen.values[1]);
  EXPECT_LT(eigen.values[1], eigen.values[2]);
}

TEST(LinearAlgebra, SolutionsSolve) {
  const MatrixXd b = (MatrixXd(3, 2) << 1, 0, 2, -1, 3, 5).finished();
  const MatrixXd& a = symmetric();
  EXPECT_LT((a * solve_symmetric(a, b) - b).norm(), 1e-14);
  EXPECT_LT((a * inverse_of_symmetric(a) - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  const MatrixXd skewed = (MatrixXd(2, 2) << 0, 2, -1, 3).finished();
  EXPECT_LT((skewed * inverse(skewed) - MatrixXd::Identity(2, 2)).norm(), 1e-15);
  const Cholesky factors(a);
  EXPECT_TRUE(factors.is_positive());
  EXPECT_LT((factors.lower() * factors.lower().transpose() - a).norm(), 1e-14);
  EXPECT_LT((factors.lower() * factors.whitened(b) - b).norm(), 1e-14);
  EXPECT_LT((a * factors.solve(b) - b).norm(), 1e-14);
  EXPECT_FALSE(Cholesky(-a).is_positive());
}

TEST(LinearAlgebra, LeastSquaresLeaveARemainderAcrossTheColumns) {
  const MatrixXd a = (MatrixXd(4, 2) << 1, 0, 1, 1, 1, 2, 1, 3).finished();
  const VectorXd b = (VectorXd(4) << 1, 2, 2, 5).finished();
  const VectorXd remainder = b - a * least_squares_solution(a, b);
  EXPECT_LT((a.transpose() * remainder).norm(), 1e-14);
  EXPECT_GT(remainder.norm(), 0.5);
}

}  // namespace
}  // namespace whipple
