// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "src/core/base/parameter_table.hpp"

namespace whipple {

/// Reads a quantity given by a command option and returns it in a unit.
/// @throws InputError naming the option: not a quantity, incompatible unit, out of range
double option_quantity(std::string_view option, std::string_view text, std::string_view unit,
                       const Range& range);

}  // namespace whipple
