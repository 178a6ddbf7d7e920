// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple {

/// Opens closed standard streams on /dev/null: otherwise the next file would be assigned to one of them and receive the
/// output. Sets the search path of programs if it is not set. Called first by `run_guarded`.
void repair_surroundings();

/// Checks that MPI can start, as MPI terminates the process uncontrollably if resources are missing. Raises the limit
/// of open files as far as permitted.
/// @throws ResourceError if the limit of open files (ulimit -n) or of the stack (ulimit -s) is too small
void require_room_for_mpi();

/// Checks that mpirun can start: with a small file size limit it allocates memory without bound instead of stopping.
/// @throws ResourceError if the file size limit (ulimit -f) is too small
void require_room_for_mpirun();

/// Allows MPI to start in a single process without a helper program, which would have to be found. Has no effect under
/// mpirun.
void let_mpi_start_alone();

}  // namespace whipple
