// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple monitor`: runs in the browser, while they go on and afterwards.
void add_monitor_command(CLI::App& app);

}  // namespace whipple::app
