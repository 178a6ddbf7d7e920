// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace whipple::input {

/// Returns the content of a TOML text with its places, for forms. Every node has "line" (from 1) and one of
///   "keys": the nodes of a table
///   "list": the nodes of a list
///   "value": text, number, or true and false; what JSON cannot express is a text
/// and, if it is written behind an equals sign, "text": as in the file.
/// @param file  of the text, for messages
/// @throws InputError with file:line:column if it is not TOML
nlohmann::json tree_of_text(const std::string& text, const std::filesystem::path& file);

}  // namespace whipple::input
