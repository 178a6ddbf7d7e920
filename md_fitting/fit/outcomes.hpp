// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/plan/adaptive.hpp"

namespace whipple::fit {

/// Holds the quantity that [adaptive] of a plan asks for, SI.
struct Outcome {
  double value = 0.0;
  std::string unit;
};

/// The outcome of a complete GRAY model.
/// @throws StateError if the model has none; InputError if the constants contradict each other
Outcome outcome_of(const eos::GrayConstants& constants, const md::AdaptivePlan& wish);

/// d(outcome)/d(constant) by differences over about a quarter of each constant's error, the range over which
/// the outcome has to be a straight line. One-sided where the other side has no outcome.
/// @param names   of GRAY's parameter table
/// @param errors  1 sigma, > 0
/// @throws StateError naming a constant that can be moved to neither side
Eigen::VectorXd outcome_gradient(const eos::GrayConstants& constants, const md::AdaptivePlan& wish,
                                 const std::vector<std::string>& names, const Eigen::VectorXd& errors);

}  // namespace whipple::fit
