// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <variant>

#include "eos/models/gray_constants.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {

/// Returns the number bound to a row of a parameter table; null for words.
inline double* number_behind(const BoundParameter& parameter) {
  double* const* target = std::get_if<double*>(&parameter.target);
  return target == nullptr ? nullptr : *target;
}

/// Returns a numerical constant of GRAY by its key.
inline double& number_of(eos::GrayConstants& constants, std::string_view name) {
  for (const BoundParameter& parameter : whipple::bind(eos::gray_parameters(), constants)) {
    double* const value = number_behind(parameter);
    if (parameter.info.name == name && value != nullptr) return *value;
  }
  throw InternalError(fmt::format("GRAY has no constant '{}'", name));
}

}  // namespace whipple::fit
