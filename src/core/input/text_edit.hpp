// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace whipple::input {

/// Holds a TOML text in which one value was set.
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

}  // namespace whipple::input
