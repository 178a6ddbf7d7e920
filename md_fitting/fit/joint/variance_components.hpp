// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

/// Estimates the sizes of random deviations of a linear model together with its parameters (docs/theory/fit.md,
/// section 9).
namespace whipple::fit {

/// Names what deviates.
enum class Deviation {
  potential,  ///< the simulations from the metal
  form,       ///< the metal from the form of the model, along all curves of a kind
  table       ///< the scale of one table
};

/// Describes a random deviation with mean zero of some rows: f^2 times a stated covariance, f being estimated.
struct VarianceComponent {
  std::string name;
  Deviation deviation = Deviation::potential;
  std::size_t of = 0;              ///< a form: the number of its kind of curve; a table: that of its curve
  std::vector<Eigen::Index> rows;  ///< of the system
  Eigen::MatrixXd covariance;      ///< of these rows at f = 1
  /// Standard deviation of ln f before the data are known; f = 1 is the most probable.
  double spread = 1.0;
};

/// Describes residuals that are linear in the parameters, r(p) = residuals + jacobian p, with the covariance
/// `fixed` + sum f_i^2 K_i.
struct LinearSystem {
  Eigen::VectorXd residuals;  ///< datum minus model at p = 0
  Eigen::MatrixXd jacobian;   ///< d(residual)/dp
  Eigen::MatrixXd noise;      ///< part of `fixed` due to the noise of the data
  Eigen::MatrixXd fixed;
  std::vector<VarianceComponent> components;

  /// Returns the covariance of the rows for logarithms of the factors.
  [[nodiscard]] Eigen::MatrixXd covariance(const Eigen::VectorXd& log_factors) const;
};

/// Holds the generalised least-squares estimate of the parameters for given factors.
struct LinearEstimate {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;              ///< (J^T Sigma^-1 J)^-1
  Eigen::MatrixXd statistical_covariance;  ///< part due to the noise of the data alone
  double chi_squared = 0.0;
};

/// Solves for the parameters. @throws StateError if the covariance is not positive, or the data leave a combination
/// of the parameters undetermined
LinearEstimate estimate(const LinearSystem& system, const Eigen::VectorXd& log_factors);

/// Returns the most probable ln f of every component: the maximum of the restricted likelihood (Patterson & Thompson,
/// Biometrika 58 (1971) 545) times the normal densities of ln f. With P = Sigma^-1 - Sigma^-1 J (J^T Sigma^-1 J)^-1
/// J^T Sigma^-1 it is the minimum of ln|Sigma| + ln|J^T Sigma^-1 J| + r^T P r + sum (ln f_i/spread_i)^2, by the BFGS
/// method of GSL.
/// @param start  ln f
/// @throws StateError as `estimate`
Eigen::VectorXd most_probable_factors(const LinearSystem& system, const Eigen::VectorXd& start);

}  // namespace whipple::fit
