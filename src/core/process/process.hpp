// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace whipple::process {

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Describes the supervision of a program that starts others, such as mpirun.
struct Supervision {
  /// Holds the signal sent to the program instead of SIGINT and SIGTERM; terminal signals do not reach it. 0: signals
  /// are passed on unchanged.
  int end_signal = 0;
  /// Selects that a signal that ends the program is reported as exit code 128 + n, not as a defect.
  bool may_be_killed = false;
  /// Sets the time, s, after which a program that has not reaped a terminated child is killed. (mpirun of Open MPI 4.1
  /// may wait forever after a rank was killed.) 0: no limit.
  double patience = 0.0;
  /// Sets the time, s, after `end_signal` at which a program that has not ended is killed with its process group.
  /// 0: no limit.
  double patience_with_end = 0.0;
};

/// Starts a program (searched in PATH unless its name contains a slash), waits for its end and returns its exit code.
/// SIGINT, SIGTERM and SIGUSR1 received by this process in the meantime are passed on, so that the program can write a
/// checkpoint; terminal signals reach it directly. Its standard input is empty.
/// @param arguments    the program and its arguments
/// @param environment  variables added to those of this process, or replacing them
/// @returns the exit code, or 128 + the signal if a signal passed on ended the program
/// @throws InputError if the program cannot be started, InternalError if another signal ended it
int run_process(const std::vector<std::string>& arguments, const Environment& environment = {},
                const Supervision& supervision = {});

/// Starts a program that continues when this process ends or its terminal is closed, without waiting for it. Its
/// standard input is empty; its output is appended to a file.
/// @throws InputError if the program cannot be started or the file cannot be written
void start_in_background(const std::vector<std::string>& arguments, const std::filesystem::path& output);

/// Returns the last signal passed on to the program last started by `run_process`; 0: none.
int last_signal();

/// Returns the number of physical cores that this process may use (two hardware threads of a core count once); at least
/// 1.
int physical_cores();

}  // namespace whipple::process
