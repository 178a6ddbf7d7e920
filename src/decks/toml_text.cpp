// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/toml_text.hpp"

#include <fmt/format.h>

#include "src/core/base/text.hpp"

namespace whipple::decks {
namespace {

/// Replaces all but printable ASCII characters: texts of decks may contain bytes of any encoding; TOML is UTF-8 without
/// control characters.
std::string printable(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return result;
}

}  // namespace

void TomlText::line(std::string content, std::string_view remark) {
  text_ += remark.empty() ? content : fmt::format("{:<48} # {}", content, printable(remark));
  text_ += '\n';
}
void TomlText::comment(std::string_view text) { text_ += "# " + printable(text) + '\n'; }
void TomlText::table(std::string_view header, std::string_view remark) {
  if (!text_.empty()) text_ += '\n';
  line(std::string(header), remark);
}
void TomlText::entry(std::string_view key, std::string_view value, std::string_view remark) {
  line(fmt::format("{} = {}", key, value), remark);
}
void TomlText::text_entry(std::string_view key, std::string_view text) {
  entry(key, toml_string(printable(text)));
}

}  // namespace whipple::decks
