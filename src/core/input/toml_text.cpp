// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/core/input/library_version.hpp"
#include "src/core/input/structure_check.hpp"

namespace whipple::input {
namespace {

InputError fault_of(std::string_view key, std::string_view value, const std::string& why) {
  return InputError(fmt::format("{}={}: {}", key, value, why));
}

/// Parses a value separately: it is then the only one of the table, without location, so that errors refer to the
/// assignment and not to line 1 of the file. Returns nothing if it is a text without quotes, as in --set
/// body.0.material=copper.toml.
std::optional<toml::table> parsed_value(std::string_view value) {
  const std::string line = fmt::format("value = {}", value);
  if (find_structure_fault(line)) return std::nullopt;
  try {
    toml::table parsed = toml::parse(line);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::string toml_library_version() {
  return fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH);
}

toml::table parse_toml(const std::string& text, const std::filesystem::path& path) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
      text.substr(0, 4).find('\0') != std::string::npos) {
    throw InputError(fmt::format(
        "{}:1:1: error: not a text in UTF-8 but, as it seems, in UTF-16; save it as UTF-8", path.string()));
  }
  if (const auto fault = find_structure_fault(text)) {
    throw InputError(
        fmt::format("{}:{}:{}: error: {}", path.string(), fault->line, fault->column, fault->what));
  }
  try {
    return toml::parse(std::string_view(text), path.string());
  } catch (const toml::parse_error& error) {
    const bool encoding = error.description().find("invalid utf-8") != std::string_view::npos;
    const toml::source_position& at = error.source().begin;
    throw InputError(
        fmt::format("{}:{}:{}: error: {}{}", path.string(), at.line, at.column, error.description(),
                    encoding ? ": letters beyond ASCII in another encoding; save the file as UTF-8" : ""));
  }
}

std::vector<std::string> key_parts(std::string_view key, std::string_view value) {
  std::vector<std::string> parts;
  std::istringstream stream{std::string(key)};
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  if (parts.empty() || key.ends_with('.') || std::ranges::any_of(parts, &std::string::empty)) {
    throw fault_of(key, value, "expected table.key=value");
  }
  return parts;
}

/// Returns whether a part of a key is the index of a list entry.
bool is_number(std::string_view part) {
  return std::ranges::all_of(part, [](unsigned char c) { return std::isdigit(c) != 0; });
}

const toml::node* child_of(const toml::node& node, std::string_view part) {
  if (const toml::table* table = node.as_table()) return table->get(part);
  const toml::array* array = node.as_array();
  if (array == nullptr || !is_number(part) || part.empty() || part.size() > 8) return nullptr;
  return array->get(std::stoul(std::string(part)));
}

toml::node* child_of(toml::node& node, std::string_view part) {
  return const_cast<toml::node*>(
      child_of(std::as_const(node), part));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

std::string value_as_toml_text(std::string_view value) {
  return parsed_value(value) ? std::string(value) : toml_string(value);
}

void set_value(toml::table& root, std::string_view key, std::string_view value) {
  const std::vector<std::string> path = key_parts(key, value);
  const auto count_fault = [&](const toml::array& list) {
    return fault_of(key, value, fmt::format("the list has {} entries, numbered from 0", list.size()));
  };
  toml::node* node = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (toml::table* table = node->as_table(); table != nullptr && !table->contains(path[i])) {
      if (is_number(path[i + 1])) {
        throw fault_of(key, value,
                       fmt::format("there is no list '{0}': [[{0}]] in the file makes one", path[i]));
      }
      table->insert(path[i], toml::table{});
    }
    toml::node* next = child_of(*node, path[i]);
    if (next == nullptr) {
      if (const toml::array* list = node->as_array()) throw count_fault(*list);
      throw fault_of(key, value, fmt::format("'{}' is neither a table nor a list", path[i]));
    }
    node = next;
  }
  const std::optional<toml::table> parsed = parsed_value(value);
  const toml::value<std::string> plain{std::string(value)};
  const toml::node& content = parsed ? *parsed->get("value") : plain;
  if (toml::table* table = node->as_table()) {
    table->insert_or_assign(path.back(), content);
  } else if (toml::array* list = node->as_array()) {
    const toml::node* entry = child_of(*list, path.back());
    if (entry == nullptr) throw count_fault(*list);
    list->replace(list->cbegin() + std::stol(path.back()), content);
  } else {
    throw fault_of(key, value, "the last part but one is neither a table nor a list");
  }
}

}  // namespace whipple::input
