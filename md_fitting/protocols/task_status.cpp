// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/task_status.hpp"

#include <map>
#include <string>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

TaskStatus status_of(const PointRecord& point, const Precision& precision) {
  if (!point.done()) return TaskStatus::failed;
  return wants_more(point, precision) ? TaskStatus::to_continue : TaskStatus::done;
}

}  // namespace

std::vector<TaskStatus> read_status(std::span<const Task> tasks, const std::filesystem::path& store,
                                    MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::vector<TaskStatus> status(tasks.size(), TaskStatus::missing);
  std::string fault;
  if (rank == 0 && std::filesystem::exists(store)) {
    try {
      std::map<std::string, PointRecord> found;
      for (PointRecord& point : read_store(store)) found[point.key] = std::move(point);
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const auto known = found.find(tasks[i].key);
        if (known != found.end()) status[i] = status_of(known->second, tasks[i].precision);
      }
    } catch (const InputError& error) {
      fault = error.what();
    }
  }
  int length = static_cast<int>(fault.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, communicator);
  fault.resize(static_cast<std::size_t>(length));
  MPI_Bcast(fault.data(), length, MPI_CHAR, 0, communicator);
  if (length > 0) throw InputError(fault);
  MPI_Bcast(status.data(), static_cast<int>(status.size()), MPI_BYTE, 0, communicator);
  return status;
}

}  // namespace whipple::md
