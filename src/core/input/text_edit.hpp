// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace whipple::input {

/// Holds a TOML text in which one value was set, or removed.
struct TextEdit {
  std::string text;
  std::string before;  ///< the replaced value; empty: the key is new
  std::string after;
  std::size_t line = 0;  ///< of the value
};

/// Sets one key in a TOML text, like `Document::set` in a document: comments, order and layout of everything else are
/// preserved. A new key follows the last one of its table.
/// @param file  of the text, for messages
/// @throws InputError if the key cannot be set, or only by rewriting its table as a whole
TextEdit set_in_text(const std::string& text, const std::filesystem::path& file, std::string_view key,
                     std::string_view value);

/// Removes one key, a table or an entry of a list: the counterpart of `set_in_text`. Comments in the same lines, and
/// within a table, go with them; everything else is preserved. A header goes with its last key, unless it has comments.
/// @throws InputError if there is no such key
TextEdit remove_from_text(const std::string& text, const std::filesystem::path& file, std::string_view key);

/// Adds an empty table, or an empty entry at the end of a list of tables, below what it belongs to.
/// @throws InputError if the key exists and is no list
TextEdit add_table_to_text(const std::string& text, const std::filesystem::path& file, std::string_view key,
                           bool is_list);

}  // namespace whipple::input
