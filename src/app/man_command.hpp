// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple man`, which prints the manual page of the program, written from its subcommands and options.
void add_man_command(CLI::App& app);

}  // namespace whipple::app
