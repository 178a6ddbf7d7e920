// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <span>
#include <vector>

namespace whipple::fit {

/// Predicts the covariance of fitted parameters with further data, in the linear approximation
/// (docs/theory/fit.md, section 8). All rows that there are or might be have one Jacobian and one covariance
/// Sigma; some are present. No value of a datum is needed, so a row counts before it is measured.
class Design {
 public:
  /// @param jacobian  of the residuals of all rows
  /// @param sigma     their covariance, from noise and model errors
  /// @param weak      standard deviations of the parameters before any datum: so large that they say nothing
  /// where a parameter is determined by data; they keep the intercepts finite of which there are no data yet
  Design(Eigen::MatrixXd jacobian, Eigen::MatrixXd sigma, Eigen::VectorXd weak,
         std::vector<Eigen::Index> present);

  /// Returns the covariance of the parameters that follows from the present rows.
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }
  [[nodiscard]] double variance(const Eigen::VectorXd& gradient) const {
    return gradient.dot(covariance_ * gradient);
  }
  /// By how much rows that are not present would lower the variance of a linear function of the parameters:
  /// equation (F8); one row is the update of rank one.
  [[nodiscard]] double reduction(std::span<const Eigen::Index> rows, const Eigen::VectorXd& gradient) const;
  /// Makes rows present.
  void add(std::span<const Eigen::Index> rows);

 private:
  void update();

  Eigen::MatrixXd jacobian_, sigma_;
  Eigen::VectorXd weak_;
  std::vector<Eigen::Index> present_;
  Eigen::LLT<Eigen::MatrixXd> factor_;  // of Sigma of the present rows
  Eigen::MatrixXd whitened_;            // their Jacobian
  Eigen::MatrixXd covariance_;
};

}  // namespace whipple::fit
