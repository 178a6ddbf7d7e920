// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

namespace whipple::parallel {

/// Initialises MPI on the first call of the process (threads: only the main thread communicates) and
/// finalises it at exit. Every later call is free. @returns MPI_COMM_WORLD
MPI_Comm world();

/// Rank and number of ranks of a communicator.
int rank(MPI_Comm comm);
int size(MPI_Comm comm);

}  // namespace whipple::parallel
