// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// Describes how well the data determine one constant.
struct Determination {
  double relative_error = 0.0;     ///< total error over the constant; infinite for a constant of zero
  double conditional_error = 0.0;  ///< error if all other constants were known, SI
  double inflation = 1.0;          ///< total over conditional error: 1 for an uncorrelated constant
  std::size_t partner = 0;         ///< constant of the largest correlation
  double correlation = 0.0;        ///< correlation with it
};

/// Describes the information content of the data about the fitted constants.
struct Identifiability {
  /// Eigenvalues of the Fisher matrix, the inverse of the covariance, in ascending order: a combination is known to
  /// eigenvalue^(-1/2). Constants are scaled by their magnitude, or by their error where that is larger.
  Eigen::VectorXd eigenvalues;
  Eigen::MatrixXd vectors;  ///< columns, normalised
  std::vector<Determination> constants;
};

/// Computes the identifiability of the constants of a fit. @throws StateError if the covariance is singular
Identifiability identifiability(const Fit& fit);

/// Formats the eigenvalues with their dominant constants, and one line for each constant.
std::string identifiability_text(const Fit& fit);

}  // namespace whipple::fit
