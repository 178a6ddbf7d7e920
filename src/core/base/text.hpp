// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace whipple {

/// ", did you mean "x"?" with the candidate nearest by edit distance; empty if none is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// Makes a text UTF-8 that need not be: names of files are bytes. @param instead  of each byte that is no part of a letter
std::string utf8(std::string_view text, std::string_view instead = "\xEF\xBF\xBD");

/// The text in double quotes, escaped as a TOML basic string.
std::string toml_string(std::string_view text);

/// Seconds as "12 s", "3 min 20 s", "2 h 05 min".
std::string format_duration(double seconds);

/// Bytes as "12.3 MB".
std::string format_bytes(double bytes);

}  // namespace whipple
