// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

/// Weighted nonlinear least squares with correlated errors (docs/theory/fit.md, section 2).
namespace whipple::fit {

/// Minimises r(p)^T Sigma^-1 r(p), Sigma = statistical + model covariance of the residuals.
struct LeastSquaresProblem {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)> residuals;
  Eigen::VectorXd start;        ///< parameters of order one are best: scale them
  Eigen::MatrixXd statistical;  ///< covariance of the residuals from the noise of the data
  Eigen::MatrixXd model;        ///< covariance of what the fitted laws leave out
};

struct LeastSquaresSolution {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;              ///< from both parts of Sigma
  Eigen::MatrixXd statistical_covariance;  ///< part that stems from the noise of the data alone
  Eigen::VectorXd residuals;               ///< as the problem defines them
  Eigen::VectorXd whitened;                ///< L^-1 r with L L^T = Sigma: unit variance, uncorrelated
  Eigen::MatrixXd jacobian;                ///< of the whitened residuals
  Eigen::MatrixXd sigma_factor;            ///< L
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  int iterations = 0;
};

/// Levenberg-Marquardt of GSL (gsl_multifit_nlinear, central differences) on the whitened residuals. The
/// covariance is (J^T J)^-1 of the whitened Jacobian; the statistical part propagates the statistical part
/// of Sigma through the same estimator, (J^T J)^-1 J^T (L^-1 Sigma_stat L^-T) J (J^T J)^-1.
/// @throws StateError if there are fewer residuals than parameters, Sigma is not positive definite, the
/// iteration does not converge, or the data leave a combination of the parameters undetermined.
LeastSquaresSolution solve(const LeastSquaresProblem& problem);

/// Straight line y = intercept + slope x, ordinary least squares: start values and plain summaries.
struct Line {
  double intercept = 0.0;
  double slope = 0.0;
};
Line fit_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace whipple::fit
