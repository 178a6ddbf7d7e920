// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "src/case/case.hpp"

namespace whipple::run {

/// Holds the end of a run and the intervals of its outputs: those of the case until a request changes them.
struct Schedule {
  double end;               ///< s, simulated time
  double snapshot_every;    ///< s, simulated time; 0: only first and last
  double checkpoint_every;  ///< s, wall-clock time; 0: only at the end and on request
  double history_every;     ///< steps
  double gauges_every;      ///< steps

  explicit Schedule(const cases::Case& setup);
  /// Copies the values to a case.
  void write_to(cases::Case& setup) const;
};

/// Lists the requests that a run accepts between two steps.
enum class Act : std::uint8_t {
  none,
  pause,
  resume,
  snapshot,
  checkpoint,
  stop,
  end,
  snapshot_every,
  checkpoint_every,
  history_every,
  gauges_every
};

/// Holds one request to a run.
struct Request {
  Act act = Act::none;
  double value = 0.0;  ///< new value in the schedule (SI); for `end`, 0 means now
};

/// Describes an action: the word that requests it and the value that it changes.
struct ActEntry {
  Act act;
  std::string_view word;
  std::string_view meaning;
  double Schedule::* changes = nullptr;  ///< null: needs no value
  std::string_view key = {};             ///< key of the case that declares unit and range of the value
};

/// Lists all actions except `none`.
std::span<const ActEntry> acts();

/// Lists the words with their meanings and values, one per line, for `whipple steer --help`.
std::string describe_acts();

/// Parses a request as written on the command line.
/// @param value  with its unit, "0.1 us"; empty: none
/// @throws InputError naming an unknown word, or a value that is missing, has another unit or is out of range
Request parse_request(const std::string& word, const std::string& value);

/// Holds the texts of a request file.
struct RequestWords {
  std::string request, value;
  static ParameterTable<RequestWords> parameters();
};

/// Reads a file `request = "WORD"`, `value = "VALUE"` (or no value). @throws InputError naming file and line
RequestWords read_request(const std::filesystem::path& file);

/// Returns the text of a request file.
std::string request_toml(const std::string& word, const std::string& value);

/// Returns the value in the schedule that an action changes, with its unit.
std::string number_of(const ActEntry& entry, const Schedule& schedule);

/// Returns the entry of an action.
const ActEntry& entry_of(Act act);

}  // namespace whipple::run
