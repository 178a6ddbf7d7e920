// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace whipple::input {

/// Where a text holds a character beyond ASCII outside of strings and comments.
struct StrayCharacter {
  unsigned line = 1;
  unsigned column = 1;
};

/// TOML allows characters beyond ASCII in strings and comments only. toml++ up to 3.4 does not refuse them
/// elsewhere but runs into an unreachable branch (https://github.com/marzer/tomlplusplus/issues/190 and 295),
/// so they are looked for before it sees the text. The same branch waits behind a backslash that ends a line
/// of a multi-line string: a character beyond ASCII that follows the line break counts as stray too.
/// @returns the first such character; none if the text may be parsed
std::optional<StrayCharacter> find_stray_character(std::string_view text);

}  // namespace whipple::input
