// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// toml++ asserts that keys begin with valid characters, which invalid input may violate ("[=]"). Without the assertion
// it reports the fault like any other; with it, debug builds would abort.
#ifndef TOML_ASSERT
#define TOML_ASSERT(condition) static_cast<void>(0)
#endif
#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Conversion of text to TOML, and values set by "table.key"; for use in this module only, as it includes the header of
/// the library.
namespace whipple::input {

/// Parses a text. @throws InputError with file:line:column
toml::table parse_toml(const std::string& text, const std::filesystem::path& path);

/// Returns the parts of "body.0.material".
/// @throws InputError naming the assignment if one is empty
std::vector<std::string> key_parts(std::string_view key, std::string_view value);

/// Returns the member of a table, or the entry of a list by its index; null if there is none.
const toml::node* child_of(const toml::node& node, std::string_view part);
toml::node* child_of(toml::node& node, std::string_view part);

/// Returns a value as TOML: unchanged, or in quotes if it is a text without quotes.
std::string value_as_toml_text(std::string_view value);

/// Sets one key; missing tables are created. @throws InputError naming the assignment
void set_value(toml::table& root, std::string_view key, std::string_view value);

}  // namespace whipple::input
