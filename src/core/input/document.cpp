// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/core/input/overlay.hpp"
#include "src/core/input/toml_text.hpp"

namespace whipple::input {

struct Document::State {
  std::filesystem::path path;
  bool needs_units = false;         ///< bare numbers are rejected
  std::optional<int> section = {};  ///< set by `set_section`
  double resolution = std::numeric_limits<double>::infinity();
  toml::table root;
  std::vector<InputFault> errors;  // sorted by position when thrown
  std::map<const toml::table*, std::set<std::string, std::less<>>> known_keys;  // keys requested by readers

  /// Returns the file that contains an item: this one, or one that it inherits from.
  [[nodiscard]] std::string file_of(const toml::source_region& source) const {
    return source.path ? *source.path : path.string();
  }
  [[nodiscard]] std::string position(const toml::source_region& source) const {
    const toml::source_position& at = source.begin;
    return at.line == 0 ? fmt::format("{} (--set)", path.string())
                        : fmt::format("{}:{}:{}", file_of(source), at.line, at.column);
  }
  void error(const toml::source_region& source, std::string key, const std::string& message) {
    InputFault fault{file_of(source), source.begin.line, source.begin.column, std::move(key), message};
    // Errors of items that are read twice are reported once.
    const auto same = [&](const InputFault& known) { return known.message() == fault.message(); };
    if (std::ranges::none_of(errors, same)) errors.push_back(std::move(fault));
  }
  void error(const toml::node& node, std::string key, const std::string& message) {
    error(node.source(), std::move(key), message);
  }
};

namespace {

toml::table& as_table(void* node) { return *static_cast<toml::table*>(node); }

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date";
  }
}

/// Reads one value of a node; throws InputError with the reason (without location).
double read_real(const toml::node& node, const ParameterInfo& info) {
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto number = node.value_exact<std::int64_t>()) return static_cast<double>(*number);
  if (const auto words = node.value_exact<std::string>()) return units::parse_quantity(*words, info.unit);
  throw InputError(
      fmt::format("is {}, expected a number{}", type_name(node),
                  info.unit.empty() ? "" : fmt::format(" with a unit, like \"1.5 {}\"", info.unit)));
}

template <class Value>
Value read_exact(const toml::node& node, const char* expected) {
  if (const auto value = node.value_exact<Value>()) return *value;
  throw InputError(fmt::format("is {}, expected {}", type_name(node), expected));
}

const toml::array& read_array(const toml::node& node, const char* expected) {
  if (const toml::array* array = node.as_array()) return *array;
  throw InputError(fmt::format("is {}, expected {}, as [\"...\", \"...\"]", type_name(node), expected));
}

void read_into(double* target, const toml::node& node, const ParameterInfo& info) {
  *target = read_real(node, info);
}
void read_into(std::int64_t* target, const toml::node& node, const ParameterInfo&) {
  *target = read_exact<std::int64_t>(node, "an integer");
}
void read_into(bool* target, const toml::node& node, const ParameterInfo&) {
  *target = read_exact<bool>(node, "true or false");
}
void read_into(std::string* target, const toml::node& node, const ParameterInfo&) {
  *target = read_exact<std::string>(node, "a text in quotes");
}
void read_into(Vector3* target, const toml::node& node, const ParameterInfo& info) {
  const toml::array& array = read_array(node, "a list of three numbers with units");
  if (array.size() != 3) throw InputError(fmt::format("has {} entries, expected 3", array.size()));
  for (int i = 0; i < 3; ++i) (*target)[i] = read_real(array[static_cast<std::size_t>(i)], info);
}
/// Reads a vector of a plane problem: two components, or three components in space.
void read_in_section(Vector3* target, const toml::node& node, const ParameterInfo& info, int first) {
  const toml::array& array = read_array(node, "a list of two numbers with units");
  if (array.size() == 3) {
    Vector3 in_space;
    read_into(&in_space, node, info);
    for (int i = 0; i < 3; ++i) (*target)[i] = in_space[(first + i) % 3];
    return;
  }
  if (array.size() != 2) throw InputError(fmt::format("has {} entries, expected 2", array.size()));
  *target = {read_real(array[0], info), read_real(array[1], info), info.across};
}
void read_into(std::vector<double>* target, const toml::node& node, const ParameterInfo& info) {
  const toml::array& array = read_array(node, "a list of numbers with units");
  std::vector<double> values;
  for (const toml::node& entry : array) values.push_back(read_real(entry, info));
  *target = values;
}
void read_into(std::vector<std::string>* target, const toml::node& node, const ParameterInfo&) {
  const toml::array& array = read_array(node, "a list of texts");
  std::vector<std::string> values;
  for (const toml::node& entry : array) values.push_back(read_exact<std::string>(entry, "a text in quotes"));
  *target = values;
}

/// Checks that the numbers of a dimensional quantity, alone or in a list, have units.
void require_units(const toml::node& node, const ParameterInfo& info) {
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& entry : *array) require_units(entry, info);
  } else if (node.is_number()) {
    units::require_no_unit(*node.value<double>(), info.unit);
  }
}

/// Returns the direction in a section, "x", "y" or "z", of a spatial direction.
std::string axis_in_section(const std::string& word, int first) {
  return std::string(1, "xyz"[(word.front() - 'x' - first + 3) % 3]);
}

/// Reads into a copy of the target and commits it only if the value is admissible.
void read_checked(const BoundParameter& parameter, const toml::node& node, std::optional<int> section) {
  const auto read = [&]<class Value>(Value& value) {
    if constexpr (std::is_same_v<Value, Vector3>) {
      section ? read_in_section(&value, node, parameter.info, *section)
              : read_into(&value, node, parameter.info);
    } else {
      read_into(&value, node, parameter.info);
    }
    const std::string fault = check({parameter.info, ParameterTarget(&value)});
    if (!fault.empty()) throw InputError(fault);
  };
  if (const ChoiceTarget* choice = std::get_if<ChoiceTarget>(&parameter.target)) {
    std::string word;
    read(word);
    choice->set(choice->value, parameter.info.is_axis && section ? axis_in_section(word, *section) : word);
    return;
  }
  std::visit(
      [&]<class Target>(const Target& target) {
        if constexpr (!std::is_same_v<Target, ChoiceTarget>) {
          auto value = *target;
          read(value);
          *target = value;
        }
      },
      parameter.target);
}

/// Converts "body[1].shape" to the form of --set, "body.1.shape".
std::string as_key(std::string_view name) {
  std::string key;
  for (const char c : name) {
    if (c != ']') key += c == '[' ? '.' : c;
  }
  return key;
}

std::string joined(const std::string& table, std::string_view key) {
  if (table.empty() || key.empty()) return table + std::string(key);
  return fmt::format("{}.{}", table, key);
}

/// Returns the node of a key, or of the innermost existing table that would contain it.
const toml::node& nearest_node(const toml::table& root, std::string_view key) {
  const toml::node* node = &root;
  while (!key.empty()) {
    const std::string part(key.substr(0, key.find('.')));
    key.remove_prefix(std::min(key.size(), part.size() + 1));
    const toml::node* next = child_of(*node, part);
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

bool is_at_or_below(std::string_view key, std::string_view above) {
  return key.starts_with(above) && (key.size() == above.size() || key[above.size()] == '.');
}

/// Reports every key below `table` not requested by any reader.
void report_unknown(Document::State& state, const toml::table& table, const std::string& name) {
  const auto& known = state.known_keys[&table];
  for (const auto& [key, node] : table) {
    const std::string key_name(key.str());
    const std::string path = name.empty() ? key_name : name + "." + key_name;
    if (!known.contains(key_name)) {
      const std::vector<std::string> candidates(known.begin(), known.end());
      const std::string suggestion = did_you_mean(key_name, candidates);
      state.error(key.source(), as_key(path),
                  fmt::format("unknown key '{}'{}{}{}", path, suggestion.empty() ? "." : suggestion,
                              candidates.empty() ? "" : " Accepted here: ", fmt::join(candidates, ", ")));
    } else if (const toml::table* child = node.as_table(); child && state.known_keys.contains(child)) {
      report_unknown(state, *child, path);
    } else if (const toml::array* array = node.as_array()) {
      std::size_t index = 0;
      for (const toml::node& entry : *array) {
        if (const toml::table* item = entry.as_table(); item && state.known_keys.contains(item)) {
          report_unknown(state, *item, fmt::format("{}[{}]", path, index));
        }
        ++index;
      }
    }
  }
}

/// Returns whether a table has values of its own, apart from remarks, its model and sub-tables.
bool has_values(const toml::table& table, std::span<const std::string_view> remarks) {
  for (const auto& [key, node] : table) {
    const bool is_remark = key.str() == "model" || std::ranges::find(remarks, key.str()) != remarks.end();
    if (!is_remark && !node.is_table() && !node.is_array_of_tables()) return true;
  }
  return false;
}

/// Moves the entries of `base` missing from `table`, except those listed in `kept`. Two tables are merged unless they
/// are of different models.
void fill(toml::table& table, toml::table& base, std::span<const std::string_view> kept,
          std::span<const std::string_view> remarks) {
  for (auto&& [key, node] : base) {
    if (std::ranges::find(kept, key.str()) != kept.end()) continue;
    toml::node* const present = table.get(key.str());
    if (present == nullptr) {
      node.visit([&](auto& concrete) { table.insert(key, std::move(concrete)); });
      continue;
    }
    toml::table *const mine = present->as_table(), *const theirs = node.as_table();
    if (mine == nullptr || theirs == nullptr) continue;
    const auto model = (*mine)["model"].value<std::string>();
    if (model && model != (*theirs)["model"].value<std::string>()) continue;
    fill(*mine, *theirs, has_values(*mine, remarks) ? remarks : std::span<const std::string_view>(), remarks);
  }
}

std::unique_ptr<Document::State> parse(const std::string& text, const std::filesystem::path& path) {
  auto state = std::make_unique<Document::State>();
  state->path = path;
  state->root = parse_toml(text, path);
  return state;
}

}  // namespace

Document::Document(std::unique_ptr<State> state) : state_(std::move(state)) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Document Document::from_file(const std::filesystem::path& path) {
  constexpr std::uintmax_t most_bytes = 16'000'000;  // of text: minutes of reading; cases are shorter
  const std::string* text = Overlay::text_of(path);
  std::unique_ptr<State> state = parse(text != nullptr ? *text : read_text(path, most_bytes), path);
  state->needs_units = true;
  return Document(std::move(state));
}

Document Document::from_text(const std::string& text, const std::string& name) {
  return Document(parse(text, name));
}

void Document::set(std::string_view key, std::string_view value) {
  try {
    set_value(state_->root, key, value);
  } catch (const InputError& fault) {
    throw InputError(fmt::format("--set {}", fault.what()));
  }
}

void Document::inherit(Document base, std::string_view link, std::span<const std::string_view> own,
                       std::span<const std::string_view> remarks) {
  state_->root.erase(link);
  fill(state_->root, base.state_->root, own, remarks);
}

std::string Document::text() const {
  std::ostringstream stream;
  stream << state_->root << '\n';
  return stream.str();
}

Table Document::root() {
  state_->known_keys[&state_->root];
  return {state_.get(), &state_->root, ""};
}

const std::filesystem::path& Document::path() const { return state_->path; }

void Document::set_section(int first) { state_->section = first; }

void Document::set_resolution(double length) { state_->resolution = length; }

void Document::finish() {
  report_unknown(*state_, state_->root, "");
  finish_partly_read();
}

void Document::finish_partly_read() {
  if (state_->errors.empty()) return;
  std::ranges::stable_sort(state_->errors, {},
                           [](const InputFault& fault) { return std::pair(fault.line, fault.column); });
  throw InputError(std::exchange(state_->errors, {}));
}

void Document::add(std::vector<InputFault> found) {
  std::erase_if(found, [&](const InputFault& fault) {
    return std::ranges::any_of(state_->errors, [&](const InputFault& known) {
      return !known.key.empty() &&
             (is_at_or_below(fault.key, known.key) || is_at_or_below(known.key, fault.key));
    });
  });
  for (const InputFault& fault : found) {
    state_->error(nearest_node(state_->root, fault.key), fault.key, fault.text);
  }
}

bool Table::read(std::span<const BoundParameter> parameters) {
  bool sound = true;
  toml::table& table = as_table(node_);
  auto& known = state_->known_keys[&table];
  for (const BoundParameter& parameter : parameters) {
    const ParameterInfo& info = parameter.info;
    known.insert(info.name);
    const toml::node* node = table.get(info.name);
    if (node == nullptr) {
      if (info.required) {
        sound = false;
        error_at(info.name, fmt::format("missing key '{}'{}: {}{}", info.name,
                                        name_.empty() ? "" : " in [" + name_ + "]", info.meaning,
                                        info.unit.empty() ? "" : " (unit " + info.unit + ")"));
      } else if (const auto* choice = std::get_if<ChoiceTarget>(&parameter.target);
                 choice != nullptr && info.is_axis && state_->section) {
        choice->set(choice->value, axis_in_section(choice->word(choice->value), *state_->section));
      }
      continue;
    }
    try {
      if (state_->needs_units) require_units(*node, info);
      read_checked(parameter, *node, state_->section);
    } catch (const InputError& fault) {
      sound = false;
      error_at(info.name, fmt::format("'{}' {}", info.name, fault.what()));
    }
  }
  return sound;
}

bool Table::has(std::string_view key) const { return as_table(node_).contains(key); }

std::optional<Table> Table::optional_table(std::string_view key) {
  state_->known_keys[&as_table(node_)].insert(std::string(key));
  toml::node* node = as_table(node_).get(key);
  if (node == nullptr) return std::nullopt;
  toml::table* table = node->as_table();
  if (table == nullptr) {
    error_at(key, fmt::format("'{}' is {}, expected a table", key, type_name(*node)));
    return std::nullopt;
  }
  state_->known_keys[table];
  return Table(state_, table, name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key));
}

std::optional<Table> Table::required_table(std::string_view key) {
  if (!has(key)) {
    state_->known_keys[&as_table(node_)].insert(std::string(key));
    error_at(key, fmt::format("missing table [{}]", joined(name_, key)));
    return std::nullopt;
  }
  return optional_table(key);
}

std::vector<Table> Table::list(std::string_view key) {
  state_->known_keys[&as_table(node_)].insert(std::string(key));
  std::vector<Table> tables;
  toml::node* node = as_table(node_).get(key);
  if (node == nullptr) return tables;
  toml::array* array = node->as_array();
  if (array == nullptr) {
    error_at(key, fmt::format("'{}' is {}, expected a list of tables [[{}]]", key, type_name(*node), key));
    return tables;
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    toml::table* table = array->get(i)->as_table();
    if (table == nullptr) {
      state_->error(
          *array->get(i), joined(key_path(), fmt::format("{}.{}", key, i)),
          fmt::format("entry {} of '{}' is {}, expected a table", i, key, type_name(*array->get(i))));
      continue;
    }
    state_->known_keys[table];
    const std::string name = fmt::format("{}[{}]", key, i);
    tables.push_back(Table(state_, table, name_.empty() ? name : name_ + "." + name));
  }
  return tables;
}

std::string Table::choice(std::string_view key, std::span<const std::string> choices,
                          std::string_view fallback) {
  std::string word(fallback);
  BoundParameter parameter{{std::string(key),
                            "",
                            {},
                            fmt::format("one of {}", fmt::join(choices, ", ")),
                            fallback.empty(),
                            {choices.begin(), choices.end()}},
                           &word};
  read(std::span(&parameter, 1));
  return word;
}

std::vector<std::string> Table::table_names() const {
  std::vector<std::pair<std::pair<unsigned, unsigned>, std::string>> found;
  for (const auto& [key, node] : as_table(node_)) {
    if (node.is_table())
      found.push_back({{key.source().begin.line, key.source().begin.column}, std::string(key.str())});
  }
  std::ranges::sort(found);
  std::vector<std::string> names;
  for (auto& [position, name] : found) names.push_back(std::move(name));
  return names;
}

void Table::accept(std::string_view key) { state_->known_keys[&as_table(node_)].insert(std::string(key)); }

std::string Table::key_path() const { return as_key(name_); }

void Table::error(const std::string& message) { state_->error(as_table(node_), key_path(), message); }

void Table::error_at(std::string_view key, const std::string& message) {
  const toml::node* node = as_table(node_).get(key);
  state_->error(node == nullptr ? as_table(node_) : *node, joined(key_path(), key), message);
}

std::string Table::where(std::string_view key) const {
  const toml::table& table = as_table(node_);
  const toml::node* node = key.empty() ? &table : table.get(key);
  return state_->position((node == nullptr ? table : *node).source());
}

std::filesystem::path Table::folder() const {
  return std::filesystem::path(state_->file_of(as_table(node_).source())).parent_path();
}

double Table::resolution() const { return state_->resolution; }

}  // namespace whipple::input
