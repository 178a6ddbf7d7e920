// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "src/core/base/error.hpp"

namespace whipple::solids {

/// Returns a piece of a foreign file for a message: at most 40 bytes, those that are no printable ASCII as \\x0A.
inline std::string shown(std::string_view piece) {
  constexpr std::size_t most = 40;
  std::string text;
  for (const char c : piece.substr(0, most)) {
    const bool is_printable = c >= ' ' && c <= '~';
    text += is_printable ? std::string(1, c) : fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
  }
  return piece.size() > most ? text + "..." : text;
}

/// Returns a text whose letters of ASCII are small.
inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

/// Walks through the lines of a text and the fields of a line, which blanks separate.
class Fields {
 public:
  /// @param lines_before  of the file, before the text
  Fields(std::string_view text, std::string file, std::size_t lines_before = 0)
      : text_(text), file_(std::move(file)), number_(lines_before) {}

  /// Goes to the next line; returns whether there is one.
  bool next_line() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }
  /// Takes the next field of the line; empty at its end.
  std::string_view word() {
    line_.remove_prefix(std::min(line_.find_first_not_of(blanks), line_.size()));
    const std::size_t end = std::min(line_.find_first_of(blanks), line_.size());
    const std::string_view field = line_.substr(0, end);
    line_.remove_prefix(end);
    return field;
  }
  /// Takes a number. @throws InputError if the next field is none, or is not finite
  template <class Number>
  Number number() {
    const std::string_view field = word();
    const std::optional<Number> value = parsed<Number>(field);
    if (!value) fail(fmt::format("expected a number instead of \"{}\"", shown(field)));
    return *value;
  }
  template <class Number>
  static std::optional<Number> parsed(std::string_view field) {
    if (field.starts_with('+')) field.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (field.empty() || error != std::errc() || end != field.data() + field.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) return std::nullopt;
    }
    return value;
  }
  /// Returns whether nothing but blanks is left of the line.
  [[nodiscard]] bool is_blank() const { return line_.find_first_not_of(blanks) == std::string_view::npos; }
  [[nodiscard]] std::string_view rest() const { return line_; }
  [[nodiscard]] std::size_t line_number() const { return number_; }
  /// Returns the number of bytes up to the next line.
  [[nodiscard]] std::size_t bytes_read() const { return std::min(at_, text_.size()); }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, number_, what));
  }

 private:
  static constexpr std::string_view blanks = " \t\r\v\f";
  std::string_view text_, line_;
  std::string file_;
  std::size_t at_ = 0, number_;
};

}  // namespace whipple::solids
