// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/words.hpp"

namespace whipple::run {

/// Describes the state of a run; a run is lost if it is active according to its file, but no process holds it.
enum class Activity : std::uint8_t { running, paused, done, stopped, failed, lost };
constexpr std::array<Word<Activity>, 6> words(Activity) {
  return {{{Activity::running, "running"},
           {Activity::paused, "paused"},
           {Activity::done, "done"},
           {Activity::stopped, "stopped"},
           {Activity::failed, "failed"},
           {Activity::lost, "lost"}}};
}
/// Returns whether a run in this state makes further steps, immediately or when it is resumed.
constexpr bool goes_on(Activity state) { return state == Activity::running || state == Activity::paused; }

/// Holds the contents of status.json of a run directory (SI; docs/manual/output.md).
struct RunStatus {
  Activity state = Activity::running;
  double time = 0.0;  ///< s, simulated
  std::int64_t step = 0;
  double time_step = 0.0;           ///< s, simulated
  double end = 0.0;                 ///< s, simulated
  double wall_time = 0.0;           ///< s, since this process started stepping
  std::optional<double> time_left;  ///< s of wall time; none: not known yet
  std::string revision;             ///< of the program
  std::string message;              ///< the last message to the user
  std::string written;              ///< local date and time
  std::string ended_by;             ///< condition of the case that ended it, in words; empty: none
};

/// Replaces the whole file.
/// @throws InputError if it cannot be written
void write_status(const std::filesystem::path& file, const RunStatus& status);

/// Reads the file of a run directory. A run that is active according to its file, but held by no process, is lost.
/// @throws InputError if there is no such file or it is damaged
RunStatus read_status(const std::filesystem::path& run);

/// Returns a status for other programs, as in `whipple status --json` and the monitor: non-finite values are null.
nlohmann::json status_json(const RunStatus& status);

/// Returns the folder if it is a run directory, otherwise the run directories in it at any depth, sorted by name. Run
/// directories are not searched, links are not followed.
/// @throws InputError if there is no such folder
std::vector<std::filesystem::path> find_runs(const std::filesystem::path& folder);

/// Returns whether a run in the folder goes on. A run whose status is damaged does not.
/// @throws InputError if there is no such folder
bool any_goes_on(const std::filesystem::path& folder);

}  // namespace whipple::run
