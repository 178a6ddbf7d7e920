// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/text_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/input/text_places.hpp"
#include "src/core/input/toml_text.hpp"

namespace whipple::input {
namespace {

/// Returns the end of the last value directly in a table; nothing if the table has none.
std::optional<std::size_t> end_of_values(const Places& places, const toml::table& table) {
  std::optional<std::size_t> last;
  for (const auto& [key, node] : table) {
    if (!is_value(node)) continue;
    last = std::max(last.value_or(0), places.of(node).end);
  }
  return last;
}

std::string dotted(std::span<const std::string> parts) { return dotted_key({parts.begin(), parts.end()}); }

/// Inserts a line below the one at a position, with the same indentation.
std::string with_line_below(const std::string& text, std::size_t place, const std::string& line) {
  const std::string line_break = line_break_of(text);
  const std::size_t previous = place == 0 ? std::string::npos : text.rfind('\n', place - 1);
  const std::size_t start = previous == std::string::npos ? 0 : previous + 1;
  const std::size_t word = text.find_first_not_of(" \t", start);
  const std::string indent = text.substr(start, std::min(word, text.size()) - start);
  const std::size_t end = text.find('\n', place);
  if (end == std::string::npos) return text + line_break + indent + line + line_break;
  return text.substr(0, end + 1) + indent + line + line_break + text.substr(end + 1);
}

/// Inserts a key in `{ ... }`, which ends at a position.
std::string with_inline_key(const std::string& text, std::size_t end, bool empty,
                            const std::string& assignment) {
  std::size_t brace = text.rfind('}', end - 1);
  const std::size_t content = text.find_last_not_of(" \t", brace - 1) + 1;
  return text.substr(0, content) + (empty ? " " : ", ") + assignment + " " + text.substr(brace);
}

/// Adds the texts that set a missing key of a table by a separate line, or within `{ ... }`.
void add_lines(std::vector<std::string>& texts, const std::string& text, const Places& places,
               const toml::table& table, bool is_root, std::span<const std::string> missing,
               const std::string& value) {
  const std::string assignment = fmt::format("{} = {}", dotted(missing), value);
  if (table.is_inline()) {
    texts.push_back(with_inline_key(text, places.of(table).end, table.empty(), assignment));
  } else if (const auto last = end_of_values(places, table)) {
    texts.push_back(with_line_below(text, *last, assignment));
  } else if (is_root) {
    texts.push_back(assignment + line_break_of(text) + text);
  } else {
    texts.push_back(with_line_below(text, places.of(table).begin, assignment));
  }
}

/// Adds the text with a new table at its end.
void add_table(std::vector<std::string>& texts, const std::string& text, std::span<const std::string> path,
               const std::string& value) {
  if (path.size() < 2) return;
  const std::string end = line_break_of(text);
  const std::string before = text.empty() ? "" : text + (text.ends_with('\n') ? "" : end) + end;
  texts.push_back(fmt::format("{}[{}]{}{} = {}{}", before, dotted(path.first(path.size() - 1)), end,
                              dotted(path.last(1)), value, end));
}

/// Returns texts that may set a missing key, the more common forms first; not all of them are correct.
/// @param known  the root and the existing nodes of the key
std::vector<std::string> with_new_key(const std::string& text, std::span<toml::node* const> known,
                                      std::span<const std::string> path, const std::string& value) {
  std::vector<std::string> texts;
  const Places places(text);
  const bool new_section = known.size() == 1 && path.size() > 1;
  if (new_section) add_table(texts, text, path, value);
  for (std::size_t depth = known.size(); depth-- > 0;) {
    const toml::table* table = known[depth]->as_table();
    if (table != nullptr) add_lines(texts, text, places, *table, depth == 0, path.subspan(depth), value);
  }
  if (!new_section) add_table(texts, text, path, value);
  return texts;
}

}  // namespace

TextEdit set_in_text(const std::string& text, const std::filesystem::path& file, std::string_view key,
                     std::string_view value) {
  toml::table root = parse_toml(text, file);
  toml::table expected = root;
  set_value(expected, key, value);
  const std::vector<std::string> path = key_parts(key, value);
  TextEdit edit;
  edit.after = value_as_toml_text(value);

  std::vector<toml::node*> known = {&root};
  while (known.size() <= path.size()) {
    toml::node* next = child_of(*known.back(), path[known.size() - 1]);
    if (next == nullptr) break;
    known.push_back(next);
  }
  std::vector<std::string> texts;
  const toml::node& node = *known.back();
  if (known.size() <= path.size()) {
    texts = with_new_key(text, known, path, edit.after);
  } else if (is_value(node)) {
    const auto [begin, end] = Places(text).of(node);
    edit.before = text.substr(begin, end - begin);
    texts.push_back(text.substr(0, begin) + edit.after + text.substr(end));
  }
  for (std::string& candidate : texts) {
    try {
      if (parse_toml(candidate, file) != expected) continue;
    } catch (const InputError&) {
      continue;
    }
    // Location of a replaced value, otherwise of the first difference of the texts.
    const auto [changed, unused] = std::ranges::mismatch(text, candidate);
    const std::size_t begin =
        edit.before.empty() ? static_cast<std::size_t>(changed - text.begin()) : Places(text).of(node).begin;
    const std::size_t place = std::min(candidate.find_first_not_of("\r\n", begin), candidate.size());
    edit.line = 1 + static_cast<std::size_t>(std::ranges::count(candidate.substr(0, place), '\n'));
    edit.text = std::move(candidate);
    return edit;
  }
  throw InputError(fmt::format(
      "{}: error: '{}' is a table of several lines, or has no single place in the text: change it "
      "in an editor",
      file.string(), key));
}

}  // namespace whipple::input
