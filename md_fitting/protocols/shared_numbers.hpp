// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>

namespace whipple::md {

/// Holds integers that all ranks can change at any time (one-sided communication), located on rank 0.
class SharedNumbers {
 public:
  enum Index : MPI_Aint { next_task, finished, stop, first_task };

  /// @param tasks number of tasks, each with one integer that is set when the task is finished
  SharedNumbers(MPI_Comm communicator, std::size_t tasks) {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    const MPI_Aint count = first_task + static_cast<MPI_Aint>(tasks);
    const MPI_Aint bytes = rank == 0 ? count * static_cast<MPI_Aint>(sizeof(long)) : 0;
    long* memory = nullptr;
    MPI_Win_allocate(bytes, sizeof(long), MPI_INFO_NULL, communicator, static_cast<void*>(&memory), &window_);
    MPI_Win_lock_all(0, window_);
    if (rank == 0) std::fill(memory, memory + count, 0L);
    MPI_Win_sync(window_);
    MPI_Barrier(communicator);
  }
  SharedNumbers(const SharedNumbers&) = delete;
  SharedNumbers& operator=(const SharedNumbers&) = delete;
  ~SharedNumbers() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  /// Adds the increment and returns the former value.
  long add(MPI_Aint index, long increment) {
    long former = 0;
    MPI_Fetch_and_op(&increment, &former, MPI_LONG, 0, index, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return former;
  }
  long read(MPI_Aint index) { return add(index, 0); }
  static MPI_Aint of_task(std::size_t task) { return first_task + static_cast<MPI_Aint>(task); }

 private:
  MPI_Win window_ = MPI_WIN_NULL;
};

}  // namespace whipple::md
