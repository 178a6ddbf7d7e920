// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace whipple::process {

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Starts a program (looked up in PATH unless its name holds a slash), waits for its end and returns its exit
/// code. SIGINT, SIGTERM and SIGUSR1 that reach this process meanwhile are passed on, so that the program can
/// write a checkpoint; the keys of the terminal reach it by themselves. Standard input of the program is
/// empty.
/// @param arguments    the program and its arguments
/// @param environment  variables added to those of this process, or replacing them
/// @returns the exit code, or 128 + the signal if a signal passed on ended the program
/// @throws InputError if the program cannot be started, InternalError if another signal ended it
int run_process(const std::vector<std::string>& arguments, const Environment& environment = {});

/// Number of physical cores that this process may use (two hardware threads of a core count once); at
/// least 1.
int physical_cores();

}  // namespace whipple::process
