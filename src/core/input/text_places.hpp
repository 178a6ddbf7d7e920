// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/core/input/toml_text.hpp"

/// Places of the values and headers of a TOML text; for use in this module only.
namespace whipple::input {

/// Returns whether a node is written behind an equals sign: a value, `{ ... }`, or `[ ... ]`.
bool is_value(const toml::node& node);

/// Holds a part of a text, from its first byte to the one after its last.
struct Extent {
  std::size_t begin = 0, end = 0;
};

/// Converts positions of toml++, counted in characters of lines, to offsets in the text, counted in bytes.
class Places {
 public:
  explicit Places(const std::string& text);

  [[nodiscard]] std::size_t offset(toml::source_position position) const;
  [[nodiscard]] Extent of(const toml::node& node) const;
  /// Returns the lines that contain a part of the text, with their last line break.
  [[nodiscard]] Extent lines(Extent part) const;
  [[nodiscard]] std::size_t line_start(std::size_t offset) const;
  /// Returns the start of the line after the one of an offset, or the end of the text.
  [[nodiscard]] std::size_t next_line(std::size_t offset) const;

 private:
  const std::string& text_;
  std::vector<std::size_t> starts_;  ///< of lines
};

/// Holds a header, `[a.b]` or `[[a.b]]`, or the start of the text, with the keys below it.
struct Block {
  std::size_t begin = 0;          ///< start of the line of the header
  std::size_t keys = 0;           ///< start of the line after it
  std::size_t end = 0;            ///< end of the last line with a key, or of the header
  std::vector<std::string> path;  ///< with the indices of list entries, "body", "1", "shape"
  bool is_list_entry = false;
};

/// Returns the blocks of a text in their order; the first one has no header.
std::vector<Block> blocks_of(const std::string& text, const toml::table& root, const Places& places);

/// Returns whether a path is inside another one, or the same.
bool starts_with(const std::vector<std::string>& path, const std::vector<std::string>& start);

/// Holds a value and where it is: the path as in `Block`.
struct Leaf {
  std::vector<std::string> path;
  Extent extent;
};

/// Returns the values of a text that are written behind an equals sign in lines of their own, in their order.
std::vector<Leaf> leaves_of(const toml::table& root, const Places& places);

/// Returns "\r\n" if the text has such line breaks.
std::string line_break_of(const std::string& text);

/// Returns keys joined by dots, in quotes where needed.
std::string dotted_key(const std::vector<std::string>& parts);

}  // namespace whipple::input
