// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple sweep`: many runs of one case, and the table of their results.
void add_sweep_command(CLI::App& app);

}  // namespace whipple::app
