// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/case.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::run {

/// Sets the number of threads of this rank: the given number, otherwise that of the environment, otherwise an equal
/// part of the processors that ranks share. Collective.
void set_threads(int threads, MPI_Comm communicator);

/// Checks before any work that memory suffices: running out of it would kill the job. Collective.
/// @throws InputError if the case needs more memory than the machines of all ranks have
void require_memory(const cases::Case& setup, MPI_Comm communicator);

}  // namespace whipple::run
