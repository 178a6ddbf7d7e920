// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace whipple {

/// Draws samples from a normal distribution of several correlated variables; equal seeds give equal samples.
class NormalSamples {
 public:
  /// Factorises the covariance.
  /// @param covariance  symmetric; may be singular, and its variables may differ by orders of magnitude
  /// @throws InputError if sizes differ, a variance is negative, or the correlations contradict each other
  NormalSamples(Eigen::VectorXd mean, const Eigen::MatrixXd& covariance, std::uint64_t seed);

  Eigen::VectorXd draw();

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd factor_;  ///< factor_ factor_^T = covariance
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace whipple
