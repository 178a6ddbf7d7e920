// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple steer`: sends a request to an active run.
void add_steer_command(CLI::App& app);
/// Adds `whipple status`: prints the progress of runs.
void add_status_command(CLI::App& app);

}  // namespace whipple::app
