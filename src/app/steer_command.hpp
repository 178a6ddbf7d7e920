// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// whipple steer: asks something of a run that goes on.
void add_steer_command(CLI::App& app);
/// whipple status: says how far runs are.
void add_status_command(CLI::App& app);

}  // namespace whipple::app
