// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple {

/// Opens standard streams that are closed, on /dev/null: the next file would take the place of one, and what is printed
/// would go into it. Sets the search path of programs where there is none. `run_guarded` calls it first of all.
void repair_surroundings();

/// Checks that MPI can start: it ends a process in ways of its own where it finds no room. Raises the limit of open files
/// as far as the process may.
/// @throws ResourceError if the limit of open files (ulimit -n) or of the stack (ulimit -s) leaves too little
void require_room_for_mpi();

/// Checks that mpirun can start: where its files must stay small it takes memory without end instead of stopping.
/// @throws ResourceError if the limit of the size of files (ulimit -f) leaves too little
void require_room_for_mpirun();

/// Lets MPI start in a process that stands alone without a helper program, which would have to be found. Without effect
/// below mpirun.
void let_mpi_start_alone();

}  // namespace whipple
