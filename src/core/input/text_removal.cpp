// SPDX-License-Identifier: BSD-3-Clause
// Keys, tables and entries of lists taken out of a text or added to it. Several texts are made, the neatest first; the
// parser decides which of them is right.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/input/text_edit.hpp"
#include "src/core/input/text_places.hpp"
#include "src/core/input/toml_text.hpp"

namespace whipple::input {
namespace {

namespace fs = std::filesystem;
using Path = std::vector<std::string>;

toml::node* node_at(toml::table& root, std::span<const std::string> path) {
  toml::node* node = &root;
  for (const std::string& part : path) {
    node = child_of(*node, part);
    if (node == nullptr) return nullptr;
  }
  return node;
}

void erase(toml::table& root, const Path& path) {
  toml::node& above = *node_at(root, std::span(path).first(path.size() - 1));
  if (toml::table* table = above.as_table()) {
    table->erase(path.back());
  } else {
    toml::array& list = *above.as_array();
    list.erase(list.cbegin() + std::stol(path.back()));
  }
}

/// Returns the documents that a removal may give: without the key, and without the tables that were headers for it only.
std::vector<toml::table> documents_without(const toml::table& root, Path path) {
  std::vector<toml::table> results;
  toml::table changed = root;
  for (;;) {
    erase(changed, path);
    results.push_back(changed);
    path.pop_back();
    if (path.empty()) break;
    const toml::node& above = *node_at(changed, path);
    const toml::node& above_that = *node_at(changed, std::span(path).first(path.size() - 1));
    const toml::table* table = above.as_table();
    const bool is_empty =
        table != nullptr ? table->empty() && !table->is_inline() : above.as_array()->empty();
    if (!is_empty || above_that.is_array()) break;
  }
  return results;
}

/// Skips blanks, line breaks and comments.
std::size_t skip_gap(const std::string& text, std::size_t at) {
  for (;;) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    if (at == text.size() || text[at] != '#') return at;
    at = std::min(text.find('\n', at), text.size());
  }
}

std::string without(const std::string& text, Extent part) {
  return text.substr(0, part.begin) + text.substr(part.end);
}

/// Returns whether a part of a text holds nothing but blanks.
bool is_blank(const std::string& text, Extent part) {
  const std::size_t word = text.find_first_not_of(" \t\r\n", part.begin);
  return word == std::string::npos || word >= part.end;
}

/// Adds the texts without one entry of `{ ... }` or `[ ... ]`.
/// @param begin  of the key, or of the entry of a list
void add_inline_removals(std::vector<std::string>& texts, const std::string& text, Extent entry) {
  const std::size_t after = skip_gap(text, entry.end);
  const std::size_t before =
      entry.begin == 0 ? std::string::npos : text.find_last_not_of(" \t\r\n", entry.begin - 1);
  const bool is_alone = before != std::string::npos && after < text.size() && text[before] != ',' &&
                        text[after] != ',' && is_blank(text, {entry.end, after});
  if (is_alone) texts.push_back(without(text, {before + 1, after}));
  if (after < text.size() && text[after] == ',') {
    const std::size_t next = std::min(text.find_first_not_of(" \t", after + 1), text.size());
    texts.push_back(without(text, {entry.begin, next}));
    texts.push_back(without(text, {entry.begin, after + 1}));
  }
  if (before != std::string::npos && text[before] == ',') texts.push_back(without(text, {before, entry.end}));
  texts.push_back(without(text, entry));
}

/// Adds the texts without a value of an inline table, whose key is searched for in front of it.
void add_inline_key_removals(std::vector<std::string>& texts, const std::string& text, Extent value,
                             std::size_t table) {
  // Candidates for the start of the key: behind every brace and comma in front of the value.
  for (std::size_t at = value.begin; at-- > table;) {
    if (text[at] != '{' && text[at] != ',') continue;
    const std::size_t start = std::min(text.find_first_not_of(" \t", at + 1), value.begin);
    add_inline_removals(texts, text, {start, value.end});
  }
}

/// Cuts lines out, and the blank lines that would be doubled, or would end the text.
std::string without_lines(std::string text, std::vector<Extent> parts) {
  std::ranges::sort(parts, {}, &Extent::begin);
  for (std::size_t i = parts.size(); i-- > 0;) {
    Extent part = parts[i];
    const auto blank_line = [&](std::size_t from) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      return end < text.size() && is_blank(text, {from, end}) ? end + 1 : from;
    };
    const bool starts_block =
        part.begin == 0 || text.find_first_not_of(" \t\r\n", part.begin) == text.find('[', part.begin);
    if (starts_block) {
      for (std::size_t next = blank_line(part.end); next != part.end; next = blank_line(part.end))
        part.end = next;
      if (is_blank(text, {part.end, text.size()})) {  // the text ends with its last line
        const std::size_t last =
            part.begin == 0 ? std::string::npos : text.find_last_not_of(" \t\r\n", part.begin - 1);
        part = {last == std::string::npos ? 0 : std::min(text.find('\n', last) + 1, part.begin), text.size()};
      }
    }
    text = without(text, part);
  }
  return text;
}

/// Returns the texts without a table of several lines: its headers with their keys, and its dotted keys elsewhere.
std::vector<std::string> without_table(const std::string& text, const toml::table& root, const Path& path) {
  const Places places(text);
  std::vector<Extent> parts;
  const std::vector<Block> blocks = blocks_of(text, root, places);
  for (const Block& block : blocks) {
    if (block.keys > 0 && starts_with(block.path, path)) parts.push_back({block.begin, block.end});
  }
  for (const Leaf& leaf : leaves_of(root, places)) {
    const bool within = std::ranges::any_of(parts, [&](const Extent& part) {
      return part.begin <= leaf.extent.begin && leaf.extent.begin < part.end;
    });
    if (!within && starts_with(leaf.path, path)) parts.push_back(places.lines(leaf.extent));
  }
  return {without_lines(text, parts)};
}

/// Returns the texts without a key that has lines of its own.
std::vector<std::string> without_lines_of(const std::string& text, const toml::table& root, Extent value) {
  const Places places(text);
  const Extent lines = places.lines(value);
  std::vector<std::string> texts;
  const std::vector<Block> blocks = blocks_of(text, root, places);
  const auto after = std::ranges::upper_bound(blocks, value.begin, {}, &Block::begin);
  const Block& block = *(after - 1);
  const std::size_t end = after == blocks.end() ? text.size() : after->begin;
  // A header of this key alone goes with it, unless comments would go as well.
  const bool alone = block.keys > 0 && !block.is_list_entry && is_blank(text, {block.keys, lines.begin}) &&
                     is_blank(text, {lines.end, end}) &&
                     text.substr(block.begin, block.keys - block.begin).find('#') == std::string::npos;
  if (alone) texts.push_back(without_lines(text, {{block.begin, lines.end}}));
  texts.push_back(without(text, lines));
  return texts;
}

std::vector<std::string> removals(const std::string& text, toml::table& root, const Path& path) {
  const toml::node& node = *node_at(root, path);
  const Places places(text);
  if (!is_value(node)) return without_table(text, root, path);
  const toml::node* outer = nullptr;  // the innermost `{ ... }` or `[ ... ]` that contains it
  for (std::size_t depth = 1; depth < path.size(); ++depth) {
    const toml::node* above = node_at(root, std::span(path).first(depth));
    if (is_value(*above)) outer = above;
  }
  if (outer == nullptr) {
    if (node_at(root, std::span(path).first(path.size() - 1))->is_array())
      return without_table(text, root, path);
    return without_lines_of(text, root, places.of(node));
  }
  std::vector<std::string> texts;
  if (outer->is_table()) {
    add_inline_key_removals(texts, text, places.of(node), places.of(*outer).begin);
  } else {
    add_inline_removals(texts, text, places.of(node));
  }
  return texts;
}

/// Returns the first text that reads as one of the documents.
std::optional<std::string> first_right(std::vector<std::string>& texts,
                                       const std::vector<toml::table>& documents, const fs::path& file) {
  for (std::string& text : texts) {
    try {
      const toml::table found = parse_toml(text, file);
      if (std::ranges::find(documents, found) != documents.end()) return std::move(text);
    } catch (const InputError&) {
      continue;
    }
  }
  return std::nullopt;
}

TextEdit edit_of(const std::string& before, std::string text) {
  TextEdit edit;
  const auto [changed, unused] = std::ranges::mismatch(before, text);
  const auto place = std::min(static_cast<std::size_t>(changed - before.begin()), text.size());
  edit.line = 1 + static_cast<std::size_t>(std::ranges::count(text.substr(0, place), '\n'));
  edit.text = std::move(text);
  return edit;
}

InputError no_place(const fs::path& file, std::string_view key) {
  return InputError(fmt::format("{}: error: '{}' has no single place in the text: change it in an editor",
                                file.string(), key));
}

/// Adds the texts with an empty table, or with a further entry of a list, as a header.
void add_headers(std::vector<std::string>& texts, const std::string& text, const toml::table& root,
                 const Path& path, bool is_list) {
  const std::string end = line_break_of(text);
  Path names;
  toml::table copy = root;
  for (std::size_t depth = 1; depth <= path.size(); ++depth) {  // indices are not written
    const toml::node* above = node_at(copy, std::span(path).first(depth - 1));
    if (above == nullptr || !above->is_array()) names.push_back(path[depth - 1]);
  }
  const std::string header = is_list ? fmt::format("[[{}]]{}", dotted_key(names), end)
                                     : fmt::format("[{}]{}", dotted_key(names), end);
  const std::vector<Block> blocks = blocks_of(text, root, Places(text));
  const Path above(path.begin(), path.end() - 1);
  for (const Path& neighbour : {path, above}) {
    const Block* last = nullptr;
    for (const Block& block : blocks) {
      if (block.keys > 0 && !neighbour.empty() && starts_with(block.path, neighbour)) last = &block;
    }
    if (last == nullptr) continue;
    const std::string head = text.substr(0, last->end);
    const std::string tail = text.substr(last->end);
    texts.push_back(head + (head.ends_with('\n') ? "" : end) + end + header +
                    (is_blank(tail, {0, tail.size()})                     ? ""
                     : tail.starts_with('\n') || tail.starts_with("\r\n") ? ""
                                                                          : end) +
                    tail);
  }
  const std::string before = text.empty() ? "" : text + (text.ends_with('\n') ? "" : end) + end;
  texts.push_back(before + header);
}

}  // namespace

TextEdit remove_from_text(const std::string& text, const fs::path& file, std::string_view key) {
  toml::table root = parse_toml(text, file);
  const Path path = key_parts(key, "");
  if (node_at(root, path) == nullptr) {
    throw InputError(fmt::format("{}: error: there is no '{}'", file.string(), key));
  }
  std::vector<std::string> texts = removals(text, root, path);
  std::optional<std::string> found = first_right(texts, documents_without(root, path), file);
  if (!found) throw no_place(file, key);
  return edit_of(text, std::move(*found));
}

TextEdit add_table_to_text(const std::string& text, const fs::path& file, std::string_view key,
                           bool is_list) {
  toml::table root = parse_toml(text, file);
  const Path path = key_parts(key, "");
  const toml::node* node = node_at(root, path);
  const toml::array* list = node != nullptr ? node->as_array() : nullptr;
  if (node != nullptr && !(is_list && list != nullptr)) {
    throw InputError(fmt::format("{}: error: there is a '{}' already", file.string(), key));
  }
  std::vector<std::string> texts;
  if (list != nullptr && is_value(*list)) {
    std::size_t bracket = Places(text).of(*list).end - 1;
    const std::size_t content = text.find_last_not_of(" \t\r\n", bracket - 1) + 1;
    texts.push_back(text.substr(0, content) + (list->empty() ? "{}" : ", {}") + text.substr(content));
    texts.push_back(text.substr(0, content) + " {}" + text.substr(content));   // behind a comma
    texts.push_back(text.substr(0, bracket) + ", {}" + text.substr(bracket));  // behind a comment
    texts.push_back(text.substr(0, bracket) + "{}" + text.substr(bracket));    // behind both
  } else {
    try {
      const std::span<const std::string> above = std::span(path).first(path.size() - 1);
      const toml::node* outer = node_at(root, above);
      if (outer != nullptr && !above.empty() && is_value(*outer)) {
        texts.push_back(set_in_text(text, file, key, is_list ? "[{}]" : "{}").text);
      }
    } catch (const InputError&) {
      throw no_place(file, key);
    }
    add_headers(texts, text, root, path, is_list);
  }
  toml::table expected = root;
  if (list != nullptr) {
    node_at(expected, path)->as_array()->push_back(toml::table{});
  } else if (is_list) {
    set_value(expected, key, "[{}]");
  } else {
    set_value(expected, key, "{}");
  }
  std::optional<std::string> found = first_right(texts, {expected}, file);
  if (!found) throw no_place(file, key);
  return edit_of(text, std::move(*found));
}

}  // namespace whipple::input
