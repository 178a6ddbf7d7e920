// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace whipple::device::check {

/// Text of a value in JSON.
class Json {
 public:
  static Json text(std::string_view of) {
    std::string quoted = "\"";
    for (const char letter : of) {
      if (letter == '"' || letter == '\\') quoted += '\\';
      quoted += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
    }
    return Json(quoted + '"');
  }
  /// Numbers that JSON does not have are null.
  static Json number(double of) {
    if (!std::isfinite(of)) return Json("null");
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.10g", of);
    return Json(digits.data());
  }
  static Json flag(bool of) { return Json(of ? "true" : "false"); }
  static Json list() { return Json('[', ']'); }
  static Json object() { return Json('{', '}'); }

  /// Adds an item to a list.
  Json& add(const Json& item) {
    separate();
    text_ += item.str();
    return *this;
  }
  /// Adds a member to an object.
  Json& set(std::string_view key, const Json& value) {
    separate();
    text_ += text(key).str() + ": " + value.str();
    return *this;
  }
  Json& set(std::string_view key, double value) { return set(key, number(value)); }
  Json& set(std::string_view key, const std::string& value) { return set(key, text(value)); }
  Json& set(std::string_view key, const char* value) { return set(key, text(value)); }

  [[nodiscard]] std::string str() const { return end_ == 0 ? text_ : text_ + end_; }

 private:
  explicit Json(std::string text) : text_(std::move(text)) {}
  Json(char begin, char end) : text_(1, begin), end_(end) {}
  void separate() {
    if (text_.size() > 1) text_ += ", ";
  }

  std::string text_;
  char end_ = 0;
};

}  // namespace whipple::device::check
