// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/normal_samples.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple {

NormalSamples::NormalSamples(Eigen::VectorXd mean, const Eigen::MatrixXd& covariance, std::uint64_t seed)
    : mean_(std::move(mean)), generator_(seed) {
  const Eigen::Index n = mean_.size();
  if (covariance.rows() != n || covariance.cols() != n) {
    throw InputError(fmt::format("a covariance of {} rows and {} columns for {} variables", covariance.rows(),
                                 covariance.cols(), n));
  }
  if (!covariance.allFinite() || !(covariance.diagonal().minCoeff() >= 0.0)) {
    throw InputError("a covariance needs finite entries and no negative variance");
  }
  // Factorises the correlation matrix, whose entries are of order one.
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse = (scale.array() > 0.0).select(scale.cwiseInverse(), 0.0);
  const Eigen::MatrixXd correlation = inverse.asDiagonal() * covariance * inverse.asDiagonal();
  constexpr double rounding = 1e-5;  // files contain seven digits
  if (!correlation.isApprox(correlation.transpose(), rounding))
    throw InputError("the covariance is not symmetric");
  const SymmetricEigen eigen = symmetric_eigen(correlation);
  if (!(eigen.values.minCoeff() > -rounding)) {
    throw InputError("the covariance is not positive: its correlations contradict each other");
  }
  factor_ = scale.asDiagonal() * eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

Eigen::VectorXd NormalSamples::draw() {
  Eigen::VectorXd deviates(mean_.size());
  for (double& deviate : deviates) deviate = normal_(generator_);
  return mean_ + factor_ * deviates;
}

}  // namespace whipple
