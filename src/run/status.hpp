// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace whipple::run {

/// What status.json of a run directory says (SI; docs/manual/output.md).
struct RunStatus {
  std::string state;  ///< running, paused, done, stopped, failed
  double time = 0.0;  ///< s, simulated
  std::int64_t step = 0;
  double time_step = 0.0;           ///< s, simulated
  double end = 0.0;                 ///< s, simulated
  double wall_time = 0.0;           ///< s, since this process began to make steps
  std::optional<double> time_left;  ///< s of wall time; none: not known yet
  std::string revision;             ///< of the program
  std::string message;              ///< the last one to the user
  std::string written;              ///< date and time of the machine
};

/// Replaces the file as a whole. @throws InputError if it cannot be written
void write_status(const std::filesystem::path& file, const RunStatus& status);

/// Reads the file of a run directory. A run that says it goes on, but is held by no process, has the state
/// "lost". @throws InputError if there is no such file or it is damaged
RunStatus read_status(const std::filesystem::path& run);

}  // namespace whipple::run
