// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/text_tree.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/core/input/text_places.hpp"
#include "src/core/input/toml_text.hpp"

namespace whipple::input {
namespace {

using nlohmann::json;

json value_of(const toml::node& node, const std::string& written) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto truth = node.value_exact<bool>()) return *truth;
  if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
  if (const auto number = node.value_exact<double>(); number && std::isfinite(*number)) return *number;
  return written;
}

json tree_of(const toml::node& node, const std::string& text, const Places& places) {
  json tree = {{"line", node.source().begin.line}};
  std::string written;
  if (is_value(node)) {
    const auto [begin, end] = places.of(node);
    written = text.substr(begin, end - begin);
    tree["text"] = written;
  }
  if (const toml::table* table = node.as_table()) {
    tree["keys"] = json::object();
    for (const auto& [key, next] : *table) tree["keys"][std::string(key.str())] = tree_of(next, text, places);
  } else if (const toml::array* list = node.as_array()) {
    tree["list"] = json::array();
    for (const toml::node& next : *list) tree["list"].push_back(tree_of(next, text, places));
  } else {
    tree["value"] = value_of(node, written);
  }
  return tree;
}

}  // namespace

json tree_of_text(const std::string& text, const std::filesystem::path& file) {
  const toml::table root = parse_toml(text, file);
  return tree_of(root, text, Places(text));
}

}  // namespace whipple::input
