// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"

namespace whipple::md {

struct Plan;

/// Describes what a call with --adaptive shall learn, and at what price; the other sections are ranges to choose from
/// (docs/theory/fit.md, section 8).
struct AdaptivePlan {
  std::string outcome;
  double volume_ratio = 0.0;    ///< of the outcomes of one Hugoniot state, V/V0 of the fit
  double pressure = 1e5;        ///< Pa: after release, or of the melting temperature
  double target_error = 0.0;    ///< relative, of the outcome; 0: none
  double budget = 0.0;          ///< atom-steps; 0: none
  std::int64_t candidates = 9;  ///< values along each range
  bool model_errors = true;     ///< the error to be lowered holds them, not the noise alone
};

/// Names of the outcomes.
inline constexpr std::array<const char*, 8> adaptive_outcomes = {"hugoniot_pressure",
                                                                 "hugoniot_temperature",
                                                                 "shock_melting_pressure",
                                                                 "shock_melting_completion_pressure",
                                                                 "release_melting_pressure",
                                                                 "release_complete_melting_pressure",
                                                                 "release_vaporisation_pressure",
                                                                 "melting_temperature"};

std::vector<BoundParameter> keys(AdaptivePlan& plan);
void check(const AdaptivePlan& section, const Plan& plan, input::Table& table);

}  // namespace whipple::md
