// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/case.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Sets the number of threads of this rank: the given number, otherwise that of the environment, otherwise an equal
/// part of the processors that ranks share. Collective.
void set_threads(int threads, MPI_Comm communicator);

/// Checks before any work that memory suffices: running out of it would kill the job. Collective.
/// @throws InputError if the case needs more memory than the machines of all ranks have
void require_memory(const cases::Case& setup, MPI_Comm communicator);

/// Requires room on the disk of a run directory for checkpoints. Collective.
/// @param count  how many more there are at a time: of a new run three, the newest two and the one being written
/// @throws InputError naming the directory, what is needed and what there is
void require_disk(const solver::Simulation& simulation, const io::RunDirectory& directory, int count,
                  const io::Ranks& ranks);

}  // namespace whipple::run
