// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace whipple {

/// Matches texts with a regular expression (ECMAScript). std::regex is compiled in one file: it is a large template.
class Pattern {
 public:
  enum class Case { distinguished, ignored };

  /// @throws std::regex_error for an expression that is none
  explicit Pattern(const std::string& expression, Case letters = Case::distinguished);

  /// Returns whether the whole text matches.
  [[nodiscard]] bool matches(const std::string& text) const;
  /// Returns the text and its groups if the whole text matches. A group that took no part is empty.
  [[nodiscard]] std::optional<std::vector<std::string>> match(const std::string& text) const;
  /// Returns whether a part of the text matches.
  [[nodiscard]] bool is_in(const std::string& text) const;
  /// Returns the first part of the text that matches, and its groups.
  [[nodiscard]] std::optional<std::vector<std::string>> find(const std::string& text) const;
  /// Returns the text with all parts that match replaced.
  [[nodiscard]] std::string replace(const std::string& text, const std::string& by) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace whipple
