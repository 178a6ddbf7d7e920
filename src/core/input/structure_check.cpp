// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/structure_check.hpp"

#include <string_view>

namespace whipple::input {
namespace {

/// Lists the states of the scanner; strings are distinguished by their delimiters.
enum class Place { structure, comment, basic, literal, multi_line_basic, multi_line_literal };

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::optional<StructureFault> run() {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // byte order mark
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const bool beyond_ascii = static_cast<unsigned char>(c) >= 0x80;
      if (beyond_ascii && (place_ == Place::structure || behind_line_break_))
        return fault("a character beyond ASCII outside of quotes");
      if (place_ == Place::structure && !count_parts(c)) return fault("a key of more than 32 parts");
      step(c);
    }
    return std::nullopt;
  }

 private:
  /// Counts the points between the parts of a key, or in a number. @returns whether there are not too many
  bool count_parts(char c) {
    constexpr int most_parts = 32;
    if (c == '.') ++points_;
    if (c == '=' || c == ',' || c == '[' || c == '{' || c == '\n') points_ = 0;
    return points_ < most_parts;
  }

  void step(char c) {
    if (behind_line_break_ && !is_blank(c)) behind_line_break_ = false;
    switch (place_) {
      case Place::structure:
        return step_in_structure(c);
      case Place::comment:
        if (c == '\n') place_ = Place::structure;
        ++at_;
        return;
      case Place::basic:
        return step_in_line(c, '"', true);
      case Place::literal:
        return step_in_line(c, '\'', false);
      case Place::multi_line_basic:
        return step_in_lines(c, R"(""")", true);
      case Place::multi_line_literal:
        return step_in_lines(c, "'''", false);
    }
  }

  void step_in_structure(char c) {
    if (take(R"(""")")) {
      place_ = Place::multi_line_basic;
    } else if (take("'''")) {
      place_ = Place::multi_line_literal;
    } else {
      if (c == '"') place_ = Place::basic;
      if (c == '\'') place_ = Place::literal;
      if (c == '#') place_ = Place::comment;
      ++at_;
    }
  }

  void step_in_line(char c, char end, bool escapes) {
    if (escapes && c == '\\') {
      at_ += 2;
      return;
    }
    if (c == end || c == '\n') place_ = Place::structure;  // toml++ stops at an unfinished string
    ++at_;
  }

  void step_in_lines(char c, std::string_view end, bool escapes) {
    if (escapes && c == '\\') {
      const std::size_t next = text_.find_first_not_of(" \t\r", at_ + 1);
      behind_line_break_ = next != std::string_view::npos && text_[next] == '\n';
      at_ += behind_line_break_ ? 1 : 2;
    } else if (take(end)) {
      // Up to two more quotes are part of the string.
      for (int i = 0; i < 2 && at_ < text_.size() && text_[at_] == end.front(); ++i) ++at_;
      place_ = Place::structure;
    } else {
      ++at_;
    }
  }

  bool take(std::string_view expected) {
    if (!text_.substr(at_).starts_with(expected)) return false;
    at_ += expected.size();
    return true;
  }

  [[nodiscard]] StructureFault fault(const char* what) const {
    StructureFault found;
    found.what = what;
    for (const char c : text_.substr(0, at_)) {
      const bool continuation = (static_cast<unsigned char>(c) & 0xc0) == 0x80;
      if (c == '\n') {
        ++found.line;
        found.column = 1;
      } else if (!continuation) {
        ++found.column;
      }
    }
    return found;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int points_ = 0;  // since the start of the last key or value
  Place place_ = Place::structure;
  bool behind_line_break_ = false;
};

}  // namespace

std::optional<StructureFault> find_structure_fault(std::string_view text) { return Scanner(text).run(); }

}  // namespace whipple::input
