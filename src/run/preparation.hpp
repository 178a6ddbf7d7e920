// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/parallel/mpi.hpp"
#include "src/setup/case.hpp"

namespace whipple::run {

/// Threads of this rank: as asked, or its share of the machine.
void set_threads(int threads, MPI_Comm communicator);

/// Before any work: a machine that runs out of memory ends the run, and others with it.
/// @throws InputError if the case takes more memory than the machines of all ranks have
void require_memory(const setup::Case& setup, MPI_Comm communicator);

}  // namespace whipple::run
