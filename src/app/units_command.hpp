// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// `whipple units`: accepted units with examples, and the conversion of a quantity.
void add_units_command(CLI::App& app);

}  // namespace whipple::app
