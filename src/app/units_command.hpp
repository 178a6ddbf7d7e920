// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple units`: lists the accepted units with examples, and converts quantities.
void add_units_command(CLI::App& app);

}  // namespace whipple::app
