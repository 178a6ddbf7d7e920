// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// Second tier of the errors: how far the constants scatter over the potentials of one element. It is kept apart from
/// the covariance of each fit, which knows its own potential only.
struct PotentialSpread {
  std::string element;
  std::vector<std::string> potentials;
  std::vector<std::string> names;  ///< constants that all of the fits determine
  std::vector<std::string> units;  ///< SI
  Eigen::MatrixXd values;          ///< a row for each potential
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;  ///< of the potentials about their mean, n - 1, SI
};

/// Scatter over fits of one element and one model; none for fewer than two of them.
std::optional<PotentialSpread> potential_spread(std::span<const Fit* const> fits);

/// Table of the values by potential with mean and standard deviation.
std::string spread_text(const PotentialSpread& spread);

}  // namespace whipple::fit
