// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace whipple::process {

using Environment = std::vector<std::pair<std::string, std::string>>;

/// How a program differs that starts others itself, as mpirun does.
struct Supervision {
  /// Sent to the program in place of SIGINT and SIGTERM; the keys of the terminal do not reach it. 0: they
  /// are passed on as they are.
  int end_signal = 0;
  /// A signal that ends the program is its exit code, 128 + n, and not a defect.
  bool may_be_killed = false;
  /// s: a program that does not notice for so long that a child of it has ended is killed. (mpirun of Open MPI 4.1
  /// may wait for ever after a rank was killed.) 0: it is waited for.
  double patience = 0.0;
  /// s: a program that has not ended so long after `end_signal` is killed, and what it has started. 0: it is waited for.
  double patience_with_end = 0.0;
};

/// Starts a program (looked up in PATH unless its name holds a slash), waits for its end and returns its exit
/// code. SIGINT, SIGTERM and SIGUSR1 that reach this process meanwhile are passed on, so that the program can
/// write a checkpoint; the keys of the terminal reach it by themselves. Standard input of the program is
/// empty.
/// @param arguments    the program and its arguments
/// @param environment  variables added to those of this process, or replacing them
/// @returns the exit code, or 128 + the signal if a signal passed on ended the program
/// @throws InputError if the program cannot be started, InternalError if another signal ended it
int run_process(const std::vector<std::string>& arguments, const Environment& environment = {},
                const Supervision& supervision = {});

/// Starts a program that goes on when this process ends or its terminal is closed, and does not wait for it. Standard
/// input is empty; what it prints is appended to a file.
/// @throws InputError if the program cannot be started or the file cannot be written
void start_in_background(const std::vector<std::string>& arguments, const std::filesystem::path& output);

/// The signal that was passed on last to the program that `run_process` started last; 0: none.
int last_signal();

/// Number of physical cores that this process may use (two hardware threads of a core count once); at
/// least 1.
int physical_cores();

}  // namespace whipple::process
