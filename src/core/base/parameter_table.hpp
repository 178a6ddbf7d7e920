// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "src/core/base/range.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"

/// One declaration per constant of a model: name, member, unit, range, meaning. It is used for reading, checks of units
/// and ranges, error messages, `whipple describe`, the manual, provenance, and the selection of constants varied in a
/// fit.
namespace whipple {

/// Describes a parameter independent of the object that contains it.
struct ParameterInfo {
  std::string name;
  std::string unit;  ///< SI unit of the value in memory; empty: dimensionless or not a number
  Range range;
  std::string meaning;
  bool required = true;
  std::vector<std::string> choices;  ///< accepted words; empty: any
  std::string default_text = {};     ///< default shown by `describe`; empty: the value
  double across = 0.0;               ///< third component of vectors given in a plane
  bool is_axis = false;              ///< a word "x", "y" or "z" that selects a spatial direction
};

/// Provides access to an enumeration value by its words, independent of its type.
struct ChoiceTarget {
  void* value;
  /// Returns the word of the value; empty if it has none.
  std::string (*word)(const void* value);
  /// Sets the value corresponding to one of the accepted words.
  void (*set)(void* value, std::string_view word);
};

template <class Enum>
ChoiceTarget choice_target(Enum& value) {
  return {&value, [](const void* from) { return std::string(word_of(*static_cast<const Enum*>(from))); },
          [](void* to, std::string_view text) {
            if (const std::optional<Enum> value = value_of<Enum>(text)) *static_cast<Enum*>(to) = *value;
          }};
}

/// Refers to the destination of a value.
using ParameterTarget = std::variant<double*, std::int64_t*, bool*, std::string*, Vector3*,
                                     std::vector<double>*, std::vector<std::string>*, ChoiceTarget>;

/// Describes a parameter bound to one object.
struct BoundParameter {
  ParameterInfo info;
  ParameterTarget target;
};

/// Describes a parameter of objects whose type only the function knows, so that code of tables is compiled once.
struct UnboundParameter {
  ParameterInfo info;
  std::function<ParameterTarget(void* owner)> target;
};

/// Describes a parameter of an object of type Owner.
template <class Owner>
struct Parameter : UnboundParameter {
  /// Makes the key optional: the initial value of the member is the default.
  [[nodiscard]] Parameter optional() && {
    info.required = false;
    return std::move(*this);
  }
  /// Makes the key optional if its initial value only marks "not given"; `default_text` describes the actual default.
  [[nodiscard]] Parameter optional(std::string default_text) && {
    info.required = false;
    info.default_text = std::move(default_text);
    return std::move(*this);
  }
  /// Declares that the word selects a spatial direction.
  [[nodiscard]] Parameter is_axis() && {
    info.is_axis = true;
    return std::move(*this);
  }
  /// Sets the third component of vectors given by two components in plane problems.
  [[nodiscard]] Parameter in_plane(double across) && {
    info.across = across;
    return std::move(*this);
  }
};

/// Lists the parameters of objects of type Owner.
template <class Owner>
class ParameterTable {
 public:
  ParameterTable() = default;
  ParameterTable(std::initializer_list<Parameter<Owner>> parameters) {
    for (const Parameter<Owner>& parameter : parameters) parameters_.push_back(parameter);
  }
  void push_back(Parameter<Owner> parameter) { parameters_.push_back(std::move(parameter)); }
  void append(const ParameterTable& further) {
    parameters_.insert(parameters_.end(), further.begin(), further.end());
  }
  void remove_if(const std::function<bool(const ParameterInfo&)>& condition) {
    std::erase_if(parameters_, [&](const UnboundParameter& parameter) { return condition(parameter.info); });
  }

  [[nodiscard]] std::span<const UnboundParameter> parameters() const { return parameters_; }
  [[nodiscard]] std::size_t size() const { return parameters_.size(); }
  auto begin() { return parameters_.begin(); }
  auto end() { return parameters_.end(); }
  auto begin() const { return parameters_.begin(); }
  auto end() const { return parameters_.end(); }

 private:
  std::vector<UnboundParameter> parameters_;
};

namespace detail {
/// Declares the parameter that a member holds.
template <class Owner, class Value>
Parameter<Owner> parameter(ParameterInfo info, Value Owner::* member) {
  return {{std::move(info),
           [member](void* owner) -> ParameterTarget { return &(static_cast<Owner*>(owner)->*member); }}};
}
}  // namespace detail

/// Declares a number with a unit.
template <class Owner>
Parameter<Owner> real(std::string name, double Owner::* member, std::string unit, Range range,
                      std::string meaning) {
  return detail::parameter<Owner>({std::move(name), std::move(unit), range, std::move(meaning), true, {}},
                                  member);
}
template <class Owner>
Parameter<Owner> integer(std::string name, std::int64_t Owner::* member, Range range, std::string meaning) {
  return detail::parameter<Owner>({std::move(name), "", range, std::move(meaning), true, {}}, member);
}
template <class Owner>
Parameter<Owner> boolean(std::string name, bool Owner::* member, std::string meaning) {
  return detail::parameter<Owner>({std::move(name), "", {}, std::move(meaning), true, {}}, member);
}
template <class Owner>
Parameter<Owner> text(std::string name, std::string Owner::* member, std::string meaning) {
  return detail::parameter<Owner>({std::move(name), "", {}, std::move(meaning), true, {}}, member);
}
/// Declares a choice of words stored as text.
template <class Owner>
Parameter<Owner> choice(std::string name, std::string Owner::* member, std::vector<std::string> choices,
                        std::string meaning) {
  return detail::parameter<Owner>({std::move(name), "", {}, std::move(meaning), true, std::move(choices)},
                                  member);
}
/// Declares a choice of the words of an enumeration (words.hpp).
template <class Owner, class Enum>
  requires std::is_enum_v<Enum>
Parameter<Owner> choice(std::string name, Enum Owner::* member, std::string meaning) {
  return {{{std::move(name), "", {}, std::move(meaning), true, word_list<Enum>()},
           [member](void* owner) -> ParameterTarget {
             return choice_target(static_cast<Owner*>(owner)->*member);
           }}};
}
/// Declares three components, each with a unit; the range applies to every component.
template <class Owner>
Parameter<Owner> vector(std::string name, Vector3 Owner::* member, std::string unit, Range range,
                        std::string meaning) {
  return detail::parameter<Owner>({std::move(name), std::move(unit), range, std::move(meaning), true, {}},
                                  member);
}
/// Declares a list of numbers with units; the range applies to every entry.
template <class Owner>
Parameter<Owner> real_list(std::string name, std::vector<double> Owner::* member, std::string unit,
                           Range range, std::string meaning) {
  return detail::parameter<Owner>({std::move(name), std::move(unit), range, std::move(meaning), true, {}},
                                  member);
}
template <class Owner>
Parameter<Owner> text_list(std::string name, std::vector<std::string> Owner::* member,
                           std::vector<std::string> choices, std::string meaning) {
  return detail::parameter<Owner>({std::move(name), "", {}, std::move(meaning), true, std::move(choices)},
                                  member);
}

/// Binds parameters to the object whose type they were declared for.
std::vector<BoundParameter> bind(std::span<const UnboundParameter> parameters, void* owner);

/// Binds a table to an object.
template <class Owner>
std::vector<BoundParameter> bind(const ParameterTable<Owner>& table, Owner& owner) {
  return whipple::bind(table.parameters(), static_cast<void*>(&owner));
}

/// Returns a table extended by the parameters of a part of its owner.
template <class Owner, class Part>
ParameterTable<Owner> with_part(ParameterTable<Owner> table, Part Owner::* part,
                                const ParameterTable<Part>& added) {
  for (const UnboundParameter& parameter : added) {
    table.push_back({{parameter.info, [part, target = parameter.target](void* owner) {
                        return target(&(static_cast<Owner*>(owner)->*part));
                      }}});
  }
  return table;
}

/// Returns the value as written in an input file: `"6580 m/s"`, `3`, `true`, `"text"`, `["1 m", "2 m", "3 m"]`.
std::string value_as_toml(const BoundParameter& parameter);

/// Returns whether the value only marks "not given" and cannot occur in an input: an infinite number, or an enumeration
/// value without a word.
bool is_unset(const BoundParameter& parameter);

/// Writes all parameters of a table as lines `name = value  # meaning`; unset ones are commented out.
std::string to_toml(std::span<const BoundParameter> parameters);

/// Writes rows "name  unit  range  default  meaning" for `whipple describe`, aligned in columns.
std::string describe(std::span<const BoundParameter> parameters);

/// Describes a table with the defaults of a default-constructed owner.
template <class Owner>
std::string describe_table(const ParameterTable<Owner>& table) {
  Owner defaults{};
  const std::vector<BoundParameter> bound = bind(table, defaults);
  return describe(bound);
}

/// Returns why the current value of the parameter is not admissible, or an empty text.
std::string check(const BoundParameter& parameter);

}  // namespace whipple
