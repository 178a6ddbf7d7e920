// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/core/process/process.hpp"

namespace whipple::process {

/// Runs a program of the project on MPI ranks of this machine, like `run_process`. The ranks end with this process,
/// even if it is killed.
/// @param program      name of the executable ("whipple-md") and its arguments
/// @param environment  variables for the ranks, in addition to those that allow Open MPI to run with more ranks than
/// cores and as root
/// @param patience_with_end  s: ranks that have not ended within this time after SIGINT or SIGTERM are killed
/// @throws InputError if there are far more ranks than processors
/// @returns the exit code of mpirun, or 128 + the signal that was passed on to end it
int mpirun(int ranks, const std::vector<std::string>& program, const Environment& environment = {},
           double patience_with_end = 300.0);

/// Runs a program of the project that uses MPI as a separate single process, also from a rank of another MPI program:
/// the environment of that program is removed, as it would otherwise join it. @returns its exit code
int run_alone(const std::vector<std::string>& program, const Environment& environment = {});

}  // namespace whipple::process
