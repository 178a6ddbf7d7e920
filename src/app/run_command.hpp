// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple run`: simulates a case, or continues an interrupted run.
void add_run_command(CLI::App& app);
/// Adds `whipple check`: validates a case and describes what would run.
void add_check_command(CLI::App& app);

}  // namespace whipple::app
