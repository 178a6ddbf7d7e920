// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// What the data say of one constant.
struct Determination {
  double relative_error =
      0.0;  ///< total error over the size of the constant; infinite for a constant of zero
  double conditional_error = 0.0;  ///< error if all other constants were known, SI
  double inflation = 1.0;          ///< total over conditional error: 1 for a constant that stands alone
  std::size_t partner = 0;         ///< constant of the largest correlation
  double correlation = 0.0;        ///< with it
};

/// Information of the data about the fitted constants.
struct Identifiability {
  /// Eigenvalues of the Fisher matrix, the inverse of the covariance, rising: a combination is known to
  /// eigenvalue^(-1/2). Constants count in units of themselves, or of their errors where these are larger.
  Eigen::VectorXd eigenvalues;
  Eigen::MatrixXd vectors;  ///< columns, normed
  std::vector<Determination> constants;
};

/// @throws StateError if the covariance is singular
Identifiability identifiability(const Fit& fit);

/// The eigenvalues with their leading constants, and one line for each constant.
std::string identifiability_text(const Fit& fit);

}  // namespace whipple::fit
