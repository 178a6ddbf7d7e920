// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace whipple::input {

/// Describes a structure that must not be passed to toml++.
struct StructureFault {
  unsigned line = 1;
  unsigned column = 1;
  const char* what = "";
};

/// Searches for two structures that TOML forbids or no input needs, and that crash toml++ up to 3.4:
/// - non-ASCII characters outside of strings and comments, which lead to an unreachable branch
///   (https://github.com/marzer/tomlplusplus/issues/190 and 295); the same branch is reached after a backslash that
///   ends a line of a multi-line string: a non-ASCII character after the line break is reported too
/// - keys with very many parts ("a.a.a..."), each of which is a nested table: their destruction overflows the stack
/// @returns the first; nothing if the text may be parsed
std::optional<StructureFault> find_structure_fault(std::string_view text);

}  // namespace whipple::input
