// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// whipple run: simulates a case, or goes on with an interrupted run.
void add_run_command(CLI::App& app);
/// whipple check: validates a case and says what would run.
void add_check_command(CLI::App& app);

}  // namespace whipple::app
