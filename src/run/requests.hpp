// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "src/case/case.hpp"

namespace whipple::run {

/// The end of a run and the intervals of its outputs: those of the case until a request changes them.
struct Schedule {
  double end;               ///< s, simulated time
  double snapshot_every;    ///< s, simulated time; 0: first and last only
  double checkpoint_every;  ///< s, wall-clock time; 0: at the end and on request only
  double history_every;     ///< steps
  double gauges_every;      ///< steps

  explicit Schedule(const cases::Case& setup);
  /// Puts the numbers into a case.
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

/// One request to a run.
struct Request {
  Act act = Act::none;
  double value = 0.0;  ///< the new number of the schedule (SI); of `end` 0: now
};

/// An act with the word that asks for it and what it changes.
struct ActEntry {
  Act act;
  std::string_view word;
  std::string_view meaning;
  double Schedule::* changes = nullptr;  ///< null: needs no value
  std::string_view key = {};             ///< of the case, which declares unit and range of the value
};

/// Lists all acts but `none`.
std::span<const ActEntry> acts();

/// Lists the words with their meanings and values, a line each, for `whipple steer --help`.
std::string describe_acts();

/// Reads a request as it is written on the command line.
/// @param value  with its unit, "0.1 us"; empty: none
/// @throws InputError naming an unknown word, a value that is missing, has another unit or is out of range
Request parse_request(const std::string& word, const std::string& value);

/// The texts of a request file.
struct RequestWords {
  std::string request, value;
  static ParameterTable<RequestWords> parameters();
};

/// Reads a file `request = "WORD"`, `value = "VALUE"` (or no value). @throws InputError naming file and line
RequestWords read_request(const std::filesystem::path& file);

/// Writes the text of such a file.
std::string request_toml(const std::string& word, const std::string& value);

/// Returns the number of the schedule that an act changes, with its unit.
std::string number_of(const ActEntry& entry, const Schedule& schedule);

/// Returns the entry of an act.
const ActEntry& entry_of(Act act);

}  // namespace whipple::run
