// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace whipple::input {

/// Locates a structure that toml++ must not see.
struct StructureFault {
  unsigned line = 1;
  unsigned column = 1;
  const char* what = "";
};

/// Looks for two things that TOML forbids or no input needs, and that toml++ up to 3.4 does not survive:
/// - characters beyond ASCII outside of strings and comments, at which it runs into an unreachable branch
///   (https://github.com/marzer/tomlplusplus/issues/190 and 295); the same branch waits behind a backslash that
///   ends a line of a multi-line string: a character beyond ASCII that follows the line break counts too
/// - keys of very many parts ("a.a.a..."), each of which is a table within a table: taking them apart again
///   overflows the stack
/// @returns the first; none if the text may be parsed
std::optional<StructureFault> find_structure_fault(std::string_view text);

}  // namespace whipple::input
