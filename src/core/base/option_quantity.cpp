// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/option_quantity.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple {

double option_quantity(std::string_view option, std::string_view text, std::string_view unit,
                       const Range& range) {
  double value = 0.0;
  try {
    value = units::parse_quantity(text, unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  if (std::isfinite(value) && range.contains(value)) return value;
  throw InputError(fmt::format("{}: is {}, but must be {}{}{}", option, text, range.text(),
                               unit.empty() ? "" : " ", unit));
}

}  // namespace whipple
