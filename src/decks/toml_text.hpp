// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace whipple::decks {

/// The text of a TOML file in the making; values are written as they stand in it.
class TomlText {
 public:
  void comment(std::string_view text);
  /// Begins a table; `header` with its brackets.
  void table(std::string_view header, std::string_view remark = {});
  void entry(std::string_view key, std::string_view value, std::string_view remark = {});
  void text_entry(std::string_view key, std::string_view text);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void line(std::string content, std::string_view remark);

  std::string text_;
};

}  // namespace whipple::decks
