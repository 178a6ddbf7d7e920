// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace whipple::decks {

/// Builds the text of a TOML file; values are given in TOML notation.
class TomlText {
 public:
  void comment(std::string_view text);
  /// Begins a table; `header` includes its brackets.
  void table(std::string_view header, std::string_view remark = {});
  void entry(std::string_view key, std::string_view value, std::string_view remark = {});
  void text_entry(std::string_view key, std::string_view text);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void line(std::string content, std::string_view remark);

  std::string text_;
};

}  // namespace whipple::decks
