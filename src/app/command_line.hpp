// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds --quiet and --verbose to a command and to all its subcommands that do not pass their arguments on.
void add_verbosity(CLI::App& command);

/// Parses the command line and runs the subcommand that it names.
/// @returns the exit code; a command ends with a code of its own by throwing CLI::RuntimeError(code)
/// @throws InputError if the arguments are wrong, with the nearest subcommand or option
int run_command_line(CLI::App& app, int argc, char** argv);

}  // namespace whipple::app
