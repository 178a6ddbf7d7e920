// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple monitor`: shows runs in the browser, both active and finished ones.
void add_monitor_command(CLI::App& app);

}  // namespace whipple::app
