// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/words.hpp"
#include "src/shields/shield.hpp"

namespace whipple::shields {

/// Holds what an experiment saw of the wall: perforated or detached spall (P), or neither (NP).
enum class Result : std::uint8_t { failed, held };
constexpr std::array<Word<Result>, 2> words(Result) {
  return {{{Result::failed, "P"}, {Result::held, "NP"}}};
}

/// Holds a row of a table of shots.
struct Shot {
  Impact impact;
  std::string source;
  std::optional<Result> result;  ///< nothing if the table does not have it
};

/// Reads a table of shots on Whipple shields (docs/manual/shields.md): comma-separated, comments with #, a heading
/// with units, "diameter [mm]".
/// @throws InputError with all faults, each with file and line: missing or unknown columns, units, alloys, numbers
std::vector<Shot> read_shots(const std::filesystem::path& file);

/// Lists the columns that such a table may have, for messages and the manual.
std::string columns_of_shots();

}  // namespace whipple::shields
