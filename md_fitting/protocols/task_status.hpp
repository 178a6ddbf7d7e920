// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "md_fitting/protocols/tasks.hpp"

namespace whipple::md {

/// What the database holds of a task.
enum class TaskStatus : std::uint8_t {
  missing,
  done,
  to_continue,  ///< done, but less accurate than the plan asks for
  failed,
};

/// Reads the status of each task on rank 0 and broadcasts it. Collective.
/// @throws InputError on every rank if the file is not a database
std::vector<TaskStatus> read_status(std::span<const Task> tasks, const std::filesystem::path& store,
                                    MPI_Comm communicator);

}  // namespace whipple::md
