// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/text_places.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "src/core/base/text.hpp"

namespace whipple::input {
namespace {

void collect(const toml::node& node, std::vector<std::string>& path, const Places& places,
             std::vector<Leaf>& leaves) {
  if (is_value(node)) {
    leaves.push_back({path, places.of(node)});
    return;
  }
  const auto visit = [&](std::string part, const toml::node& next) {
    path.push_back(std::move(part));
    collect(next, path, places, leaves);
    path.pop_back();
  };
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, next] : *table) visit(std::string(key.str()), next);
  } else if (const toml::array* list = node.as_array()) {
    for (std::size_t i = 0; i < list->size(); ++i) visit(std::to_string(i), *list->get(i));
  }
}

/// Returns the keys of a header, which is parsed alone.
std::vector<std::string> keys_of(const std::string& header) {
  const toml::table alone = toml::parse(std::string_view(header));
  std::vector<std::string> keys;
  const toml::node* node = &alone;
  while (node != nullptr) {
    if (const toml::array* list = node->as_array()) node = list->get(0);
    const toml::table* table = node->as_table();
    if (table == nullptr || table->empty()) break;
    keys.emplace_back(table->begin()->first.str());
    node = &table->begin()->second;
  }
  return keys;
}

}  // namespace

bool is_value(const toml::node& node) {
  if (const toml::table* table = node.as_table()) return table->is_inline();
  const toml::array* array = node.as_array();
  return array == nullptr || !array->is_array_of_tables() || array->get(0)->as_table()->is_inline();
}

Places::Places(const std::string& text) : text_(text), starts_({0}) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
    starts_.push_back(at + 1);
  }
}

std::size_t Places::offset(toml::source_position position) const {
  const std::size_t line = std::max<std::size_t>(position.line, 1) - 1;
  std::size_t at = line < starts_.size() ? starts_[line] : text_.size();
  for (std::uint32_t column = 1; column < position.column && at < text_.size(); ++column) {
    ++at;
    while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

Extent Places::of(const toml::node& node) const {
  return {offset(node.source().begin), offset(node.source().end)};
}

std::size_t Places::line_start(std::size_t offset) const {
  return *(std::ranges::upper_bound(starts_, offset) - 1);
}

std::size_t Places::next_line(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(starts_, offset);
  return next == starts_.end() ? text_.size() : *next;
}

Extent Places::lines(Extent part) const {
  return {line_start(part.begin), next_line(std::max(part.end, part.begin + 1) - 1)};
}

std::vector<Leaf> leaves_of(const toml::table& root, const Places& places) {
  std::vector<Leaf> leaves;
  std::vector<std::string> path;
  collect(root, path, places, leaves);
  std::ranges::sort(leaves, {}, [](const Leaf& leaf) { return leaf.extent.begin; });
  return leaves;
}

std::vector<Block> blocks_of(const std::string& text, const toml::table& root, const Places& places) {
  const std::vector<Leaf> leaves = leaves_of(root, places);
  std::vector<Block> blocks(1);
  std::map<std::vector<std::string>, std::size_t> entries;  // of lists so far
  auto leaf = leaves.begin();
  for (std::size_t line = 0; line < text.size(); line = places.next_line(line)) {
    while (leaf != leaves.end() && leaf->extent.end <= line) ++leaf;
    const std::size_t word = text.find_first_not_of(" \t", line), end = places.next_line(line);
    const bool within = leaf != leaves.end() && leaf->extent.begin < line;
    if (within || word >= end || text[word] != '[') continue;
    Block block{.begin = line, .keys = end, .end = end, .path = {}, .is_list_entry = text[word + 1] == '['};
    const std::vector<std::string> keys = keys_of(text.substr(line, end - line));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      block.path.push_back(keys[i]);
      const bool opens = block.is_list_entry && i + 1 == keys.size();
      if (opens) ++entries[block.path];
      if (const auto list = entries.find(block.path); list != entries.end()) {
        block.path.push_back(std::to_string(list->second - 1));
      }
    }
    blocks.push_back(std::move(block));
  }
  for (const Leaf& each : leaves) {
    const auto after = std::ranges::upper_bound(blocks, each.extent.begin, {}, &Block::begin);
    Block& block = *(after - 1);
    block.end = std::max(block.end, places.lines(each.extent).end);
  }
  return blocks;
}

bool starts_with(const std::vector<std::string>& path, const std::vector<std::string>& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

std::string line_break_of(const std::string& text) {
  return text.find("\r\n") == std::string::npos ? "\n" : "\r\n";
}

std::string dotted_key(const std::vector<std::string>& parts) {
  std::vector<std::string> keys;
  for (const std::string& part : parts) {
    const bool bare = !part.empty() && std::ranges::all_of(part, [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    keys.push_back(bare ? part : toml_string(part));
  }
  return fmt::format("{}", fmt::join(keys, "."));
}

}  // namespace whipple::input
