// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"

/// One declaration per constant of a model: name, member, unit, range, meaning. It drives reading, unit and
/// range checks, error texts, `whipple describe`, the manual, provenance and which constants a fit may vary.
namespace whipple {

/// Admissible range of a number; infinite bounds mean no bound.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  [[nodiscard]] bool contains(double value) const;
  /// "> 0", ">= 0 and < 0.5", "any"
  [[nodiscard]] std::string text() const;
};

namespace range {
inline Range any() { return {}; }
inline Range positive() { return {.lower = 0.0, .lower_open = true}; }
inline Range non_negative() { return {.lower = 0.0}; }
inline Range between(double lower, double upper) { return {.lower = lower, .upper = upper}; }
inline Range open_between(double lower, double upper) {
  return {.lower = lower, .upper = upper, .lower_open = true, .upper_open = true};
}
}  // namespace range

/// Describes a parameter without the object that it belongs to.
struct ParameterInfo {
  std::string name;
  std::string unit;  ///< SI unit of the value in memory; empty: dimensionless or not a number
  Range range;
  std::string meaning;
  bool required = true;
  std::vector<std::string> choices;  ///< accepted words; empty: any
  std::string default_text = {};     ///< what `describe` shows as default; empty: the value
  double across = 0.0;               ///< third component of a vector that is given in a plane
  bool is_axis = false;              ///< a word "x", "y" or "z" that names a direction of space
};

/// An enumeration's value behind its words, whatever its type.
struct ChoiceTarget {
  void* value;
  /// Returns the word of the value; empty if it has none.
  std::string (*word)(const void* value);
  /// Sets the value to that of one of the accepted words.
  void (*set)(void* value, std::string_view word);
};

template <class Enum>
ChoiceTarget choice_target(Enum& value) {
  return {&value, [](const void* from) { return std::string(word_of(*static_cast<const Enum*>(from))); },
          [](void* to, std::string_view text) {
            if (const std::optional<Enum> value = value_of<Enum>(text)) *static_cast<Enum*>(to) = *value;
          }};
}

/// Where a value goes.
using ParameterTarget = std::variant<double*, std::int64_t*, bool*, std::string*, Vector3*,
                                     std::vector<double>*, std::vector<std::string>*, ChoiceTarget>;

/// A parameter tied to one object.
struct BoundParameter {
  ParameterInfo info;
  ParameterTarget target;
};

template <class Owner>
struct Parameter {
  using Member = std::variant<double Owner::*, std::int64_t Owner::*, bool Owner::*, std::string Owner::*,
                              Vector3 Owner::*, std::vector<double> Owner::*,
                              std::vector<std::string> Owner::*, std::function<ParameterTarget(Owner&)>>;
  ParameterInfo info;
  Member member;

  /// The key may be missing: the member's initial value stands.
  [[nodiscard]] Parameter optional() && {
    info.required = false;
    return std::move(*this);
  }
  /// Lets the key be missing where the initial value only marks that: `default_text` says what stands in for it.
  [[nodiscard]] Parameter optional(std::string default_text) && {
    info.required = false;
    info.default_text = std::move(default_text);
    return std::move(*this);
  }
  /// The word names a direction of space.
  [[nodiscard]] Parameter is_axis() && {
    info.is_axis = true;
    return std::move(*this);
  }
  /// The third component of a vector of which two are given, in problems in a plane.
  [[nodiscard]] Parameter in_plane(double across) && {
    info.across = across;
    return std::move(*this);
  }
};

template <class Owner>
using ParameterTable = std::vector<Parameter<Owner>>;

/// A number with a unit.
template <class Owner>
Parameter<Owner> real(std::string name, double Owner::* member, std::string unit, Range range,
                      std::string meaning) {
  return {{std::move(name), std::move(unit), range, std::move(meaning), true, {}}, member};
}
template <class Owner>
Parameter<Owner> integer(std::string name, std::int64_t Owner::* member, Range range, std::string meaning) {
  return {{std::move(name), "", range, std::move(meaning), true, {}}, member};
}
template <class Owner>
Parameter<Owner> boolean(std::string name, bool Owner::* member, std::string meaning) {
  return {{std::move(name), "", {}, std::move(meaning), true, {}}, member};
}
template <class Owner>
Parameter<Owner> text(std::string name, std::string Owner::* member, std::string meaning) {
  return {{std::move(name), "", {}, std::move(meaning), true, {}}, member};
}
/// One of some words that stay words.
template <class Owner>
Parameter<Owner> choice(std::string name, std::string Owner::* member, std::vector<std::string> choices,
                        std::string meaning) {
  return {{std::move(name), "", {}, std::move(meaning), true, std::move(choices)}, member};
}
/// One of the words of an enumeration (words.hpp).
template <class Owner, class Enum>
  requires std::is_enum_v<Enum>
Parameter<Owner> choice(std::string name, Enum Owner::* member, std::string meaning) {
  return {{std::move(name), "", {}, std::move(meaning), true, word_list<Enum>()},
          std::function<ParameterTarget(Owner&)>(
              [member](Owner& owner) { return choice_target(owner.*member); })};
}
/// Three components, each with a unit; the range holds for every component.
template <class Owner>
Parameter<Owner> vector(std::string name, Vector3 Owner::* member, std::string unit, Range range,
                        std::string meaning) {
  return {{std::move(name), std::move(unit), range, std::move(meaning), true, {}}, member};
}
/// A list of numbers with units; the range holds for every entry.
template <class Owner>
Parameter<Owner> real_list(std::string name, std::vector<double> Owner::* member, std::string unit,
                           Range range, std::string meaning) {
  return {{std::move(name), std::move(unit), range, std::move(meaning), true, {}}, member};
}
template <class Owner>
Parameter<Owner> text_list(std::string name, std::vector<std::string> Owner::* member,
                           std::vector<std::string> choices, std::string meaning) {
  return {{std::move(name), "", {}, std::move(meaning), true, std::move(choices)}, member};
}

/// Returns where the value of a parameter goes in an object.
template <class Owner>
ParameterTarget target_of(const Parameter<Owner>& parameter, Owner& owner) {
  return std::visit(
      [&](const auto& member) -> ParameterTarget {
        if constexpr (requires { member(owner); }) {
          return member(owner);
        } else {
          return &(owner.*member);
        }
      },
      parameter.member);
}

/// Ties a table to an object.
template <class Owner>
std::vector<BoundParameter> bind(const ParameterTable<Owner>& table, Owner& owner) {
  std::vector<BoundParameter> bound;
  bound.reserve(table.size());
  for (const Parameter<Owner>& parameter : table)
    bound.push_back({parameter.info, target_of(parameter, owner)});
  return bound;
}

/// Returns a table with the parameters of a part of its owner at its end.
template <class Owner, class Part>
ParameterTable<Owner> with_part(ParameterTable<Owner> table, Part Owner::* part,
                                const ParameterTable<Part>& added) {
  for (const Parameter<Part>& parameter : added) {
    table.push_back({parameter.info, std::function<ParameterTarget(Owner&)>([part, parameter](Owner& owner) {
                       return target_of(parameter, owner.*part);
                     })});
  }
  return table;
}

/// The value as it stands in an input file: `"6580 m/s"`, `3`, `true`, `"text"`, `["1 m", "2 m", "3 m"]`.
std::string value_as_toml(const BoundParameter& parameter);

/// Returns whether the value only marks "not given", as no input may hold it: an infinite number, or a value
/// of an enumeration that has no word.
bool is_unset(const BoundParameter& parameter);

/// All parameters of a table as lines `name = value  # meaning`; the line of an unset one is a comment.
std::string to_toml(std::span<const BoundParameter> parameters);

/// Rows "name  unit  range  default  meaning" for `whipple describe`, aligned in columns.
std::string describe(std::span<const BoundParameter> parameters);

/// `describe` of a table with the defaults of a default-constructed owner.
template <class Owner>
std::string describe_table(const ParameterTable<Owner>& table) {
  Owner defaults{};
  const std::vector<BoundParameter> bound = bind(table, defaults);
  return describe(bound);
}

/// Returns why the present value of the parameter is not admissible, or an empty text.
std::string check(const BoundParameter& parameter);

}  // namespace whipple
