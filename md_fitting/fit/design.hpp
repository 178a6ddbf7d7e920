// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {

/// Predicts the covariance of fitted parameters with further data, in the linear approximation (docs/theory/fit.md,
/// section 8). All existing and candidate rows share one Jacobian and one covariance Sigma; a subset is present.
/// Values of the data are not needed, so a row can be evaluated before it is measured.
class Design {
 public:
  /// @param jacobian  of the residuals of all rows
  /// @param sigma     their covariance, from noise and model errors
  /// @param weak      prior standard deviations of the parameters: large enough to carry no information where data
  /// determine a parameter; they keep intercepts without data finite
  Design(Eigen::MatrixXd jacobian, Eigen::MatrixXd sigma, Eigen::VectorXd weak,
         std::vector<Eigen::Index> present);

  /// Returns the covariance of the parameters given the present rows.
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }
  [[nodiscard]] double variance(const Eigen::VectorXd& gradient) const {
    return gradient.dot(covariance_ * gradient);
  }
  /// Returns the decrease of the variance of a linear function of the parameters due to rows that are not yet
  /// present, equation (F8); a single row is a rank-one update.
  [[nodiscard]] double reduction(std::span<const Eigen::Index> rows, const Eigen::VectorXd& gradient) const;
  /// Marks rows as present.
  void add(std::span<const Eigen::Index> rows);

 private:
  void update();

  Eigen::MatrixXd jacobian_, sigma_;
  Eigen::VectorXd weak_;
  std::vector<Eigen::Index> present_;
  Cholesky factor_;           // of Sigma of the present rows
  Eigen::MatrixXd whitened_;  // their Jacobian
  Eigen::MatrixXd covariance_;
};

}  // namespace whipple::fit
