// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "src/core/base/linear_algebra.hpp"

/// Solves weighted nonlinear least-squares problems with correlated errors (docs/theory/fit.md, section 2).
namespace whipple::fit {

/// Describes the minimisation of r(p)^T Sigma^-1 r(p), Sigma = statistical + model covariance of the residuals.
struct LeastSquaresProblem {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)> residuals;
  Eigen::VectorXd start;        ///< parameters should be scaled to order one
  Eigen::MatrixXd statistical;  ///< covariance of the residuals from the noise of the data
  Eigen::MatrixXd model;        ///< covariance of the model discrepancy of the fitted laws
};

struct LeastSquaresSolution {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;              ///< from both parts of Sigma
  Eigen::MatrixXd statistical_covariance;  ///< part due to the noise of the data alone
  Eigen::VectorXd residuals;               ///< as the problem defines them
  Eigen::VectorXd whitened;                ///< L^-1 r with L L^T = Sigma: unit variance, uncorrelated
  Eigen::MatrixXd jacobian;                ///< of the whitened residuals
  Cholesky sigma_factor;                   ///< L
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  int iterations = 0;
};

/// Minimises by the Levenberg-Marquardt method of GSL (gsl_multifit_nlinear, central differences) on the whitened
/// residuals. The covariance is (J^T J)^-1 of the whitened Jacobian; the statistical part propagates the
/// statistical part of Sigma through the same estimator, (J^T J)^-1 J^T (L^-1 Sigma_stat L^-T) J (J^T J)^-1.
/// @throws StateError if there are fewer residuals than parameters, Sigma is not positive definite, the
/// iteration does not converge, or the data leave a combination of the parameters undetermined.
LeastSquaresSolution solve(const LeastSquaresProblem& problem);

/// Holds a straight line y = intercept + slope x from ordinary least squares, for start values and simple summaries.
struct Line {
  double intercept = 0.0;
  double slope = 0.0;
};
Line fit_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace whipple::fit
