// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "src/core/base/error.hpp"

/// Provides points of numpy arrays and the states computed from them, for the bindings of this folder.
namespace whipple::python {

namespace py = pybind11;

/// Holds any sequence of numbers that numpy converts without loss, as contiguous doubles: no complex numbers, no
/// masked values.
class Numbers : public py::array_t<double, py::array::c_style | py::array::forcecast> {
 public:
  using array_t::array_t;
};
/// Converts an argument.
/// @throws InputError for complex numbers and masked values; returns nothing if numpy cannot convert it to numbers
std::optional<Numbers> numbers_of(const py::handle& argument);
using OptionalNumbers = std::optional<Numbers>;
using Shape = std::vector<py::ssize_t>;

/// Returns the same numbers as a read-only array, or a number if there is one.
py::object read_only(const py::array& array);

/// Holds arrays of one shape.
struct Points {
  std::vector<Numbers> columns;  ///< in the given order, omitting absent ones
  Shape shape;
  std::size_t size = 1;

  /// Returns the values of all points of a column.
  [[nodiscard]] std::span<const double> column(std::size_t place) const {
    return {columns[place].data(), size};
  }
};

/// Broadcasts arrays to their common shape by the rules of numpy.
/// @throws ValueError of numpy if there is none
Points broadcast(std::initializer_list<OptionalNumbers> given);

/// Returns a number if the shape is scalar, otherwise the array.
py::object number_or_array(const py::array& array);

/// Holds names of states that were read from a pickle.
struct RestoredNames {
  std::string model;
  std::set<std::string> phases;
};

/// Holds states of an equation of state over an array of points. Each property is an array view of these states,
/// without a copy.
struct States {
  std::shared_ptr<const eos::EquationOfState> eos;  ///< owns the phase names
  Shape shape;
  std::vector<eos::State> states;
  /// Further columns in addition to the state: shock velocities, Riemann velocities.
  std::vector<std::vector<double>> further = {};
  std::shared_ptr<const RestoredNames> restored = {};  ///< from a pickle, without equation of state

  [[nodiscard]] std::string model() const { return eos ? std::string(eos->model()) : restored->model; }
  /// Returns the only state.
  /// @throws InputError if there are several
  [[nodiscard]] const eos::State& single() const;
};
struct Shocks : States {};      ///< further: shock velocity, particle velocity
struct Isentropes : States {};  ///< further: Riemann velocity
struct Releases : States {};    ///< further: Riemann velocity, 1 if the end is in equilibrium

/// Holds the states on both sides of an interface, over an array of velocities.
struct Impact {
  Shape shape;
  std::vector<double> pressure, velocity;
  States left, right;
  std::vector<double> right_shock_velocity;
};

/// Creates a result of points with space for its further columns.
template <class Kind>
Kind make(std::shared_ptr<const eos::EquationOfState> eos, const Points& points, std::size_t further) {
  Kind result;
  result.eos = std::move(eos);
  result.shape = points.shape;
  result.states.resize(points.size);
  result.further.assign(further, std::vector<double>(points.size, eos::State::unknown));
  return result;
}

/// Returns numbers as an array of a shape, or as a number.
py::object array_of(const Shape& shape, const std::vector<double>& values);

/// Declares the classes of states above.
void add_states(py::module_& module);

/// Lets Python interrupt a long loop on Ctrl-C; called without the interpreter's lock.
void check_signals();

/// Computes a result for each of the points, without the interpreter's lock.
/// @param keep    keep(i, inputs of the point) computes and stores one result
/// @param refuse  stores the absence of a result; null: the StateError of the point is thrown, with its index
template <class Keep, class Refuse>
void for_each_point(const Points& points, const Keep& keep, const Refuse* refuse) {
  constexpr std::size_t between_signals = 1024;
  py::gil_scoped_release unlocked;
  std::vector<double> inputs(points.columns.size());
  for (std::size_t i = 0; i < points.size; ++i) {
    if (i % between_signals == 0) check_signals();
    try {
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        inputs[k] = points.column(k)[i];
        if (!std::isfinite(inputs[k]))
          throw StateError(fmt::format("no state of a quantity that is {}", inputs[k]));
      }
      keep(i, inputs);
    } catch (const StateError& error) {
      if (refuse == nullptr) {
        throw StateError(points.size == 1 ? error.what()
                                          : fmt::format("point {} of {}: {}", i, points.size, error.what()));
      }
      (*refuse)(i);
    }
  }
}

/// Computes the states of points by a function of their inputs.
template <class Function>
States states_of(std::shared_ptr<const eos::EquationOfState> eos, const Points& points, bool skip_invalid,
                 const Function& function) {
  States result{std::move(eos), points.shape, std::vector<eos::State>(points.size)};
  const auto keep = [&](std::size_t i, const std::vector<double>& inputs) {
    result.states[i] = function(inputs);
  };
  const auto refuse = [&](std::size_t i) {
    result.states[i].melted_fraction = result.states[i].vaporised_fraction = eos::State::unknown;
  };
  for_each_point(points, keep, skip_invalid ? &refuse : nullptr);
  return result;
}

}  // namespace whipple::python

/// Converts function arguments to `whipple::python::Numbers` by `numbers_of`.
template <>
struct pybind11::detail::type_caster<whipple::python::Numbers> {
  PYBIND11_TYPE_CASTER(whipple::python::Numbers, const_name("numpy.ndarray[numpy.float64]"));

  bool load(handle source, bool) {
    const std::optional<whipple::python::Numbers> numbers = whipple::python::numbers_of(source);
    if (numbers) value = *numbers;
    return numbers.has_value();
  }
  static handle cast(const whipple::python::Numbers& numbers, return_value_policy, handle) {
    return numbers.inc_ref();
  }
};
