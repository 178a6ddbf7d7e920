// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace whipple {

/// Returns ", did you mean "x"?" with the candidate nearest by edit distance; empty if none is close.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// Converts a text that may not be UTF-8 to UTF-8, as file names are arbitrary bytes. @param instead  replaces each
/// invalid byte
std::string utf8(std::string_view text, std::string_view instead = "\xEF\xBF\xBD");

/// Returns the text in double quotes, escaped as a TOML basic string.
std::string toml_string(std::string_view text);

/// Returns seconds as "12 s", "3 min 20 s", "2 h 05 min".
std::string format_duration(double seconds);

/// Returns bytes as "12.3 MB".
std::string format_bytes(double bytes);

}  // namespace whipple
