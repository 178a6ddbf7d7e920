// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/schema.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/core/base/json.hpp"
#include "src/core/base/units.hpp"

namespace whipple::input {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

Schema of_type(const char* type) {
  Schema value;
  value["type"] = type;
  return value;
}

bool has_unit(const ParameterInfo& info) { return !info.unit.empty(); }

void limit(Schema& number, const Range& range) {
  if (std::isfinite(range.lower)) number[range.lower_open ? "exclusiveMinimum" : "minimum"] = range.lower;
  if (std::isfinite(range.upper)) number[range.upper_open ? "exclusiveMaximum" : "maximum"] = range.upper;
}

/// Returns the schema of a quantity, a text "6.58 km/s". Signs are checked if all units share the same zero.
Schema quantity(const ParameterInfo& info) {
  const bool signed_number = !(info.range.lower >= 0.0) || info.unit == "K";
  Schema text = of_type("string");
  text["pattern"] = fmt::format("^ *[+{}]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)? *(1/|[^ 0-9.+-]).*$",
                                signed_number ? "-" : "");
  if (!info.range.contains(0.0)) return text;
  Schema zero, either;
  zero["const"] = 0;
  either["anyOf"] = Schema::array({std::move(text), std::move(zero)});
  return either;
}

Schema number(const ParameterInfo& info) {
  if (has_unit(info)) return quantity(info);
  Schema plain = of_type("number"), text = of_type("string"), either;
  limit(plain, info.range);
  text["pattern"] = "^ *[+-]?[0-9.]";
  either["anyOf"] = Schema::array({std::move(plain), std::move(text)});
  return either;
}

Schema word(const std::vector<std::string>& choices) {
  Schema text = of_type("string");
  if (!choices.empty()) text["enum"] = choices;
  return text;
}

Schema list_of(Schema items) {
  Schema list = of_type("array");
  list["items"] = std::move(items);
  return list;
}

/// Returns the default as JSON; null if the initial value only marks that there is none.
Schema default_of(const BoundParameter& parameter) {
  const ParameterInfo& info = parameter.info;
  if (info.required || is_unset(parameter) || !info.default_text.empty()) return {};
  const auto quantity_or_number = [&](double value) -> Schema {
    if (has_unit(info)) return units::format_quantity(value, info.unit);
    return value;
  };
  return std::visit(
      Overloaded{[&](double* value) { return quantity_or_number(*value); },
                 [](std::int64_t* value) { return Schema(*value); },
                 [](bool* value) { return Schema(*value); },
                 [](std::string* value) { return Schema(*value); },
                 [&](Vector3* value) {
                   return Schema::array({quantity_or_number((*value)[0]), quantity_or_number((*value)[1]),
                                         quantity_or_number((*value)[2])});
                 },
                 [&](std::vector<double>* values) {
                   Schema list = Schema::array();
                   for (const double value : *values) list.push_back(quantity_or_number(value));
                   return list;
                 },
                 [](std::vector<std::string>* values) { return Schema(*values); },
                 [](const ChoiceTarget& choice) { return Schema(choice.word(choice.value)); }},
      parameter.target);
}

/// Returns meaning, range and unit, as shown by editors.
std::string description_of(const ParameterInfo& info) {
  std::string text = info.meaning;
  if (has_unit(info)) text += fmt::format(" [{}]", info.unit);
  const std::string range = info.choices.empty() ? info.range.text() : "any";
  if (range != "any") text += fmt::format(", {}", range);
  if (!info.default_text.empty()) text += fmt::format("; default: {}", info.default_text);
  return text;
}

Schema value_of(const BoundParameter& parameter) {
  const ParameterInfo& info = parameter.info;
  Schema value = std::visit(
      Overloaded{[&](double*) { return number(info); },
                 [&](std::int64_t*) {
                   Schema whole = of_type("integer");
                   limit(whole, info.range);
                   return whole;
                 },
                 [](bool*) { return of_type("boolean"); }, [&](std::string*) { return word(info.choices); },
                 [&](Vector3*) {
                   Schema list = list_of(number(info));
                   list["minItems"] = 2;  // in a plane
                   list["maxItems"] = 3;
                   return list;
                 },
                 [&](std::vector<double>*) { return list_of(number(info)); },
                 [&](std::vector<std::string>*) { return list_of(word(info.choices)); },
                 [&](const ChoiceTarget&) { return word(info.choices); }},
      parameter.target);
  value["description"] = description_of(info);
  if (Schema text = default_of(parameter); !text.is_null()) value["default"] = std::move(text);
  return value;
}

}  // namespace

void add_key(Schema& table, const std::string& name, const Schema& value, bool required) {
  table["type"] = "object";
  table["properties"][name] = value;
  if (required) table["required"].push_back(name);
  table["additionalProperties"] = false;
}

void add_keys(Schema& table, std::span<const BoundParameter> parameters) {
  for (const BoundParameter& parameter : parameters) {
    add_key(table, parameter.info.name, value_of(parameter), parameter.info.required);
  }
}

void add_section(Schema& table, const SchemaSection& section, void (*fill)(Schema&)) {
  Schema content;
  fill(content);
  Schema value = section.is_list ? list_of(std::move(content)) : std::move(content);
  const std::size_t start = section.remark.find_first_not_of(",: ");
  if (start != std::string::npos) value["description"] = section.remark.substr(start);
  add_key(table, section.name, value, section.required);
}

Schema reference_to(const std::string& definition) {
  Schema value;
  value["$ref"] = "#/$defs/" + definition;
  return value;
}

std::string schema_text(const Schema& table, const std::string& title, const std::string& description) {
  Schema all;
  all["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  all["title"] = title;
  all["description"] = description;
  all.update(table);
  return json_text(all, 2) + "\n";
}

}  // namespace whipple::input
