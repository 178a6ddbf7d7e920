// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/parameter_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"

namespace whipple {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::string quantity_as_toml(double value, const std::string& unit) {
  if (unit.empty()) {
    // TOML would read "0" as an integer.
    const std::string text = fmt::format("{}", value);
    return text.find_first_of(".ein") == std::string::npos ? text + ".0" : text;
  }
  return fmt::format("\"{}\"", units::format_quantity(value, unit));
}

std::string check_number(double value, const ParameterInfo& info) {
  if (std::isnan(value)) return "is not a number (NaN)";
  if (std::isinf(value)) return "is infinite";
  if (info.range.contains(value)) return {};
  return fmt::format("is {}, but must be {}", units::format_quantity(value, info.unit),
                     info.range.text() + (info.unit.empty() ? "" : " " + info.unit));
}

std::string check_word(const std::string& word, const ParameterInfo& info) {
  if (info.choices.empty() || std::ranges::find(info.choices, word) != info.choices.end()) return {};
  const std::string suggestion = did_you_mean(word, info.choices);
  return fmt::format("is \"{}\"{} Accepted: {}", word, suggestion.empty() ? "." : suggestion,
                     fmt::join(info.choices, ", "));
}

template <class Values, class Check>
std::string first_fault(const Values& values, Check check_one) {
  for (const auto& value : values) {
    std::string fault = check_one(value);
    if (!fault.empty()) return fault;
  }
  return {};
}

/// Returns the default as shown by `describe`; an infinite one means that there is no bound.
std::string default_of(const BoundParameter& parameter) {
  if (parameter.info.required) return "required";
  if (!parameter.info.default_text.empty()) return parameter.info.default_text;
  return is_unset(parameter) ? "no bound" : value_as_toml(parameter);
}

/// Writes the words of a list in indented lines of at most a hundred columns.
std::string wrapped(const std::vector<std::string>& words) {
  constexpr std::size_t columns = 100;
  std::string result;
  std::string line = "     ";
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > columns) {
      result += line + "\n";
      line = "     ";
    }
    line += " " + word;
  }
  return result + line + "\n";
}

}  // namespace

std::vector<BoundParameter> bind(std::span<const UnboundParameter> parameters, void* owner) {
  std::vector<BoundParameter> bound;
  bound.reserve(parameters.size());
  for (const UnboundParameter& parameter : parameters)
    bound.push_back({parameter.info, parameter.target(owner)});
  return bound;
}

std::string value_as_toml(const BoundParameter& parameter) {
  const std::string& unit = parameter.info.unit;
  return std::visit(
      Overloaded{[&](double* value) { return quantity_as_toml(*value, unit); },
                 [&](std::int64_t* value) { return fmt::format("{}", *value); },
                 [&](bool* value) { return std::string(*value ? "true" : "false"); },
                 [&](std::string* value) { return toml_string(*value); },
                 [&](Vector3* value) {
                   return fmt::format("[{}, {}, {}]", quantity_as_toml((*value)[0], unit),
                                      quantity_as_toml((*value)[1], unit),
                                      quantity_as_toml((*value)[2], unit));
                 },
                 [&](std::vector<double>* values) {
                   std::vector<std::string> items;
                   for (const double value : *values) items.push_back(quantity_as_toml(value, unit));
                   return fmt::format("[{}]", fmt::join(items, ", "));
                 },
                 [&](std::vector<std::string>* values) {
                   std::vector<std::string> items;
                   for (const std::string& value : *values) items.push_back(toml_string(value));
                   return fmt::format("[{}]", fmt::join(items, ", "));
                 },
                 [](const ChoiceTarget& choice) { return toml_string(choice.word(choice.value)); }},
      parameter.target);
}

bool is_unset(const BoundParameter& parameter) {
  if (double* const* number = std::get_if<double*>(&parameter.target)) return std::isinf(**number);
  const ChoiceTarget* choice = std::get_if<ChoiceTarget>(&parameter.target);
  return choice != nullptr && choice->word(choice->value).empty();
}

std::string to_toml(std::span<const BoundParameter> parameters) {
  std::string result;
  for (const BoundParameter& parameter : parameters) {
    result += fmt::format("{}{} = {}  # {}\n", is_unset(parameter) ? "# " : "", parameter.info.name,
                          value_as_toml(parameter), parameter.info.meaning);
  }
  return result;
}

std::string describe(std::span<const BoundParameter> parameters) {
  constexpr std::size_t widest_range = 44;  // longer lists of words are placed below their row
  std::vector<std::array<std::string, 5>> rows = {{"key", "unit", "range", "default", "meaning"}};
  std::vector<std::string> below = {""};
  for (const BoundParameter& parameter : parameters) {
    const ParameterInfo& info = parameter.info;
    std::string range =
        info.choices.empty() ? info.range.text() : fmt::format("{}", fmt::join(info.choices, " | "));
    const bool wide = range.size() > widest_range;
    below.push_back(wide ? wrapped(info.choices) : "");
    if (wide) range = "words below";
    std::string value = default_of(parameter);
    if (value.size() > widest_range) {
      below.back() += "      default: " + value + "\n";
      value = "below";
    }
    rows.push_back({info.name, info.unit.empty() ? "-" : info.unit, range, value, info.meaning});
  }
  std::array<std::size_t, 5> width{};
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    result += fmt::format("  {:<{}}  {:<{}}  {:<{}}  {:<{}}  {}\n", row[0], width[0], row[1], width[1],
                          row[2], width[2], row[3], width[3], row[4]);
    result += below[i];
  }
  return result;
}

std::string check(const BoundParameter& parameter) {
  const ParameterInfo& info = parameter.info;
  const auto number = [&](double value) { return check_number(value, info); };
  const auto word = [&](const std::string& value) { return check_word(value, info); };
  return std::visit(
      Overloaded{[&](double* value) { return number(*value); },
                 [&](std::int64_t* value) { return number(static_cast<double>(*value)); },
                 [](bool*) { return std::string(); }, [&](std::string* value) { return word(*value); },
                 [&](Vector3* value) {
                   return first_fault(std::array{(*value)[0], (*value)[1], (*value)[2]}, number);
                 },
                 [&](std::vector<double>* values) { return first_fault(*values, number); },
                 [&](std::vector<std::string>* values) { return first_fault(*values, word); },
                 [](const ChoiceTarget&) { return std::string(); }},
      parameter.target);
}

}  // namespace whipple
