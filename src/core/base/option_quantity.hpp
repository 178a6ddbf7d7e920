// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "src/core/base/parameter_table.hpp"

namespace whipple {

/// Reads a quantity that is given by an option of a command, and returns it in the unit.
/// @throws InputError naming the option: no quantity, another kind of unit, out of the range
double option_quantity(std::string_view option, std::string_view text, std::string_view unit,
                       const Range& range);

}  // namespace whipple
