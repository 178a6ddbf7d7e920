// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/faults.hpp"

namespace whipple::md {

struct Plan;

/// Describes the result that a call with --adaptive improves, and the permitted cost; the other sections are the
/// ranges from which points are chosen (docs/theory/fit.md, section 8).
struct AdaptivePlan {
  std::string outcome;
  /// V/V0 (V0 of the fit) at the Hugoniot state of an outcome; infinite: not given.
  double volume_ratio = std::numeric_limits<double>::infinity();
  double pressure = 1e5;        ///< Pa: after release, or for the melting temperature
  double target_error = 0.0;    ///< relative, of the outcome; 0: none
  double budget = 0.0;          ///< atom-steps; 0: none
  std::int64_t candidates = 9;  ///< values along each range
  bool model_errors = true;     ///< the error to be reduced includes them, not only the noise

  static ParameterTable<AdaptivePlan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
};

/// Lists the names of the outcomes.
inline constexpr std::array<const char*, 8> adaptive_outcomes = {"hugoniot_pressure",
                                                                 "hugoniot_temperature",
                                                                 "shock_melting_pressure",
                                                                 "shock_melting_completion_pressure",
                                                                 "release_melting_pressure",
                                                                 "release_complete_melting_pressure",
                                                                 "release_vaporisation_pressure",
                                                                 "melting_temperature"};

}  // namespace whipple::md
