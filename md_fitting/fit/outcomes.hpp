// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/plan/adaptive.hpp"

namespace whipple::fit {

/// Holds the quantity that [adaptive] of a plan names, SI.
struct Outcome {
  double value = 0.0;
  std::string unit;
};

/// Evaluates the outcome for a complete GRAY model.
/// @throws StateError if the model has none; InputError if the constants contradict each other
Outcome outcome_of(const eos::GrayConstants& constants, const md::AdaptivePlan& wish);

/// Returns d(outcome)/d(constant) from differences over about a quarter of each constant's error, the range over which
/// the outcome should be linear. Uses one-sided differences where the outcome does not exist on the other side.
/// @param names   of GRAY's parameter table
/// @param errors  1 sigma, > 0
/// @throws StateError naming a constant that can be varied in neither direction
Eigen::VectorXd outcome_gradient(const eos::GrayConstants& constants, const md::AdaptivePlan& wish,
                                 const std::vector<std::string>& names, const Eigen::VectorXd& errors);

}  // namespace whipple::fit
