// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/tensor.hpp"

/// Fields declared by material models: the history of a point in addition to the state that all points have
/// (docs/theory/material.md, section 11). They are stored and moved with the fields of material_points.hpp.
namespace whipple {

/// Selects the tensor rank of a value.
enum class Rank : std::uint8_t { scalar, vector, symmetric_tensor, tensor };

/// Selects how a value is transported in a step before it is passed to the model.
enum class Convection : std::uint8_t {
  kept,       ///< unchanged: numbers, and tensors of the reference configuration
  corotated,  ///< rotated with the material: R a R^T
  deformed,   ///< a deformation gradient: (I + dt L) F
};

/// Declares a history field of a model.
struct HistoryField {
  std::string name;
  std::string unit;
  std::string meaning;
  Rank rank = Rank::scalar;
  Convection convection = Convection::kept;
  double neutral =
      0.0;           ///< of undisturbed points and points that do not need the field; tensors: times identity
  Range range = {};  ///< valid range of the components in a checkpoint
};

/// Returns the number of components of a value.
constexpr std::size_t components_of(Rank rank) {
  switch (rank) {
    case Rank::scalar:
      return 1;
    case Rank::vector:
      return 3;
    case Rank::symmetric_tensor:
      return 6;
    case Rank::tensor:
      return 9;
  }
  return 0;
}

/// Returns the neutral value of a type: tensors are multiples of the identity.
template <class Value>
Value neutral_value(double neutral) {
  if constexpr (std::is_same_v<Value, Matrix3>) {
    return neutral * Matrix3::Identity();
  } else if constexpr (std::is_same_v<Value, SymmetricTensor>) {
    return {neutral, neutral, neutral, 0.0, 0.0, 0.0};
  } else if constexpr (std::is_same_v<Value, Vector3>) {
    return Vector3::Constant(neutral);
  } else {
    return neutral;
  }
}

/// Holds a declared field of a set of points: empty if no point needs it, otherwise one value per point.
struct History {
  using Values = std::variant<std::vector<double>, std::vector<Vector3>, std::vector<SymmetricTensor>,
                              std::vector<Matrix3>>;  ///< in the order of `Rank`
  HistoryField field;
  Values values;

  explicit History(HistoryField declared);
};

/// Holds the histories of a set of points, sorted by name: sets with the same fields have them in the same order.
class Histories {
 public:
  [[nodiscard]] auto begin() { return all_.begin(); }
  [[nodiscard]] auto end() { return all_.end(); }
  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }

  /// Returns the history with a name; null if there is none.
  [[nodiscard]] const History* find(const std::string& name) const;
  /// Returns the numbers, vectors or tensors of a field, one per point.
  /// @throws InternalError if there is no field of that name with such values
  template <class Value>
  [[nodiscard]] const std::vector<Value>& values(const std::string& name) const {
    const History* history = find(name);
    const auto* values = history == nullptr ? nullptr : std::get_if<std::vector<Value>>(&history->values);
    if (values == nullptr)
      throw InternalError("no model of these points declares the field \"" + name + "\"");
    return *values;
  }
  template <class Value>
  [[nodiscard]] std::vector<Value>& values(const std::string& name) {
    return const_cast<std::vector<Value>&>(std::as_const(*this).template values<Value>(name));
  }
  /// Returns the numbers of a field of rank `scalar`.
  [[nodiscard]] const std::vector<double>& scalar(const std::string& name) const {
    return values<double>(name);
  }
  [[nodiscard]] std::vector<double>& scalar(const std::string& name) { return values<double>(name); }
  /// Returns the tensors of a field of rank `symmetric_tensor`.
  [[nodiscard]] const std::vector<SymmetricTensor>& symmetric(const std::string& name) const {
    return values<SymmetricTensor>(name);
  }
  [[nodiscard]] std::vector<SymmetricTensor>& symmetric(const std::string& name) {
    return values<SymmetricTensor>(name);
  }

  /// Returns the history of a field, which is added, empty, if the points do not have it yet.
  /// @throws InputError if another field of that name differs in unit, rank or convection
  History& add(const HistoryField& field);
  /// Activates a field on `count` points: new values are neutral.
  void declare(const HistoryField& field, std::size_t count);

 private:
  std::vector<History> all_;
};

/// Provides access to a history with values of one type, with the interface of `Field`.
template <class Value>
struct HistoryOf {
  const HistoryField& declared;
  const char* name;
  const char* unit;
  static constexpr bool optional = true;

  /// Returns the values of any set of points that may have the field; an empty array for a set without it.
  template <class Points>
  [[nodiscard]] auto& of(Points& points) const {
    if constexpr (std::is_const_v<Points>) {
      static const std::vector<Value> none;
      const History* history = points.history.find(declared.name);
      return history == nullptr ? none : std::get<std::vector<Value>>(history->values);
    } else {
      return std::get<std::vector<Value>>(points.history.add(declared).values);
    }
  }
  /// Resizes the field; new points have the neutral value.
  template <class Points>
  void resize(Points& points, std::size_t n) const {
    of(points).resize(n, neutral_value<Value>(declared.neutral));
  }
};

}  // namespace whipple
