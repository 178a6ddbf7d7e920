// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// Holds the second tier of the errors: the scatter of the constants over the potentials of one element. It is kept
/// separate from the covariance of each fit, which covers one potential only.
struct PotentialSpread {
  std::string element;
  std::vector<std::string> potentials;
  std::vector<std::string> names;  ///< constants determined by all of the fits
  std::vector<std::string> units;  ///< SI
  Eigen::MatrixXd values;          ///< one row per potential
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;  ///< of the potentials about their mean, normalised by n - 1, SI
};

/// Computes the scatter over fits of one element and one model; returns none for fewer than two fits.
std::optional<PotentialSpread> potential_spread(std::span<const Fit* const> fits);

/// Formats the values by potential with mean and standard deviation.
std::string spread_text(const PotentialSpread& spread);

}  // namespace whipple::fit
