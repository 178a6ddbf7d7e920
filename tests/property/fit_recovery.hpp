// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "md_fitting/fit/gray_fit.hpp"
#include "tests/unit/fit_support.hpp"

/// What the tests of recovered constants share.
namespace whipple::fit::testing {

inline const std::vector<std::string> fitted = {
    "reference_specific_volume", "hugoniot_intercept",          "hugoniot_slope",      "gruneisen",
    "gruneisen_slope",           "anharmonic_heat_coefficient", "melting_temperature", "melting_entropy"};

inline std::vector<double> values(const eos::GrayConstants& c) {
  return {
      c.reference_specific_volume, c.hugoniot_intercept,          c.hugoniot_slope,      c.gruneisen,
      c.gruneisen_slope,           c.anharmonic_heat_coefficient, c.melting_temperature, c.melting_entropy};
}

inline FitSettings noise_only() {
  FitSettings settings = independent_errors({});
  settings.model_errors = ModelErrors::none();
  settings.electrons = "none";  // as in the data
  return settings;
}

}  // namespace whipple::fit::testing
