// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace whipple::input {

/// A text of TOML in which one value was set.
struct TextEdit {
  std::string text;
  std::string before;  ///< the value that was replaced; empty: the key is new
  std::string after;
  std::size_t line = 0;  ///< of the value
};

/// Sets one key in a text of TOML as `Document::set` does in a document that was read: comments, order and
/// layout of all else stay. A new key follows the last one of its table.
/// @param file  that the text is of, for messages
/// @throws InputError if the key cannot be set, or stands where only its table as a whole could be rewritten
TextEdit set_in_text(const std::string& text, const std::filesystem::path& file, std::string_view key,
                     std::string_view value);

}  // namespace whipple::input
