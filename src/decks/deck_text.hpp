// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "src/core/base/files.hpp"

namespace whipple::decks {

/// Reads a deck, or a file that it includes, without the UTF-8 byte order mark.
/// @throws InputError if it cannot be read, is not a regular file or is larger than 1 GiB
inline std::string deck_text(const std::filesystem::path& path) {
  std::string text = read_text(path, std::uintmax_t{1} << 30);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

}  // namespace whipple::decks
