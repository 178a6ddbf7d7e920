// SPDX-License-Identifier: BSD-3-Clause
#include "python/eos/states.hpp"

#include <algorithm>

#include "python/eos/pickling.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple::python {
namespace {

struct Property {
  const char* name;
  double eos::State::* member;
  const char* meaning;
};

constexpr Property properties[] = {
    {"density", &eos::State::density, "Density, kg/m^3."},
    {"energy", &eos::State::specific_internal_energy, "Specific internal energy, J/kg."},
    {"temperature", &eos::State::temperature, "Temperature, K; NaN if the model carries none."},
    {"pressure", &eos::State::pressure, "Pressure, Pa, positive in compression."},
    {"sound_speed", &eos::State::sound_speed, "Isentropic (bulk) sound speed, m/s."},
    {"entropy", &eos::State::specific_entropy, "Specific entropy, J/(kg K)."},
    {"heat_capacity", &eos::State::heat_capacity, "Heat capacity at constant volume, J/(kg K)."},
    {"isobaric_heat_capacity", &eos::State::isobaric_heat_capacity,
     "Heat capacity at constant pressure, J/(kg K)."},
    {"gruneisen", &eos::State::gruneisen, "Grueneisen parameter V (dp/de)_V, without unit."},
    {"isothermal_bulk_modulus", &eos::State::isothermal_bulk_modulus, "Isothermal bulk modulus, Pa."},
    {"isentropic_bulk_modulus", &eos::State::isentropic_bulk_modulus, "Isentropic bulk modulus rho c^2, Pa."},
    {"thermal_expansion", &eos::State::thermal_expansion,
     "Volumetric thermal expansion at constant pressure, 1/K."},
    {"helmholtz_energy", &eos::State::helmholtz_energy, "Specific Helmholtz energy e - T s, J/kg."},
    {"gibbs_energy", &eos::State::gibbs_energy, "Specific Gibbs energy e - T s + p/rho, J/kg."},
    {"melted_fraction", &eos::State::melted_fraction, "Mass fraction of liquid and vapour, 0 to 1."},
    {"vaporised_fraction", &eos::State::vaporised_fraction, "Mass fraction of vapour, 0 to 1."},
    {"distension", &eos::State::distension,
     "Volume over that of the material without its pores, without unit."},
};

/// Returns a view of one member of all states: not a copy, owned by the Python object that holds the states.
py::object view(const py::object& self, double eos::State::* member) {
  const States& s = self.cast<const States&>();
  Shape strides(s.shape.size());
  py::ssize_t stride = sizeof(eos::State);
  for (std::size_t k = s.shape.size(); k-- > 0; stride *= s.shape[k]) strides[k] = stride;
  static const eos::State none;
  const eos::State& first = s.states.empty() ? none : s.states.front();
  py::array array(py::dtype::of<double>(), s.shape, strides, &(first.*member), self);
  array.attr("setflags")(py::arg("write") = false);
  return number_or_array(array);
}

py::object further(const States& s, std::size_t place) {
  return read_only(Numbers(s.shape, s.further[place].data()));
}

/// Returns the length of arrays of a shape, following len() of numpy.
py::ssize_t length_of(const Shape& shape) {
  if (shape.empty()) throw py::type_error("a single state has no length");
  return shape.front();
}

py::object phases(const States& s) {
  py::list names;
  for (const eos::State& state : s.states) names.append(py::str(std::string(state.phase)));
  py::array array = py::module_::import("numpy").attr("array")(names, "str").attr("reshape")(s.shape);
  return number_or_array(array);
}

/// Formats some quantities of the first states as a table.
std::string table_text(const States& s) {
  constexpr std::size_t most_rows = 20;
  std::vector<std::vector<std::string>> rows = {
      {"density [kg/m^3]", "temperature [K]", "pressure [Pa]", "energy [J/kg]", "phase"}};
  for (std::size_t i = 0; i < std::min(most_rows, s.states.size()); ++i) {
    const eos::State& state = s.states[i];
    rows.push_back({fmt::format("{:.6g}", state.density), fmt::format("{:.6g}", state.temperature),
                    fmt::format("{:.6g}", state.pressure),
                    fmt::format("{:.6g}", state.specific_internal_energy), std::string(state.phase)});
  }
  std::string text = text_table(rows, "rrrrl");
  if (s.states.size() > most_rows) text += fmt::format("... {} states in all\n", s.states.size());
  return text;
}

/// Returns the states at an index or slice of numpy.
template <class Kind>
Kind subset(const Kind& s, const py::object& index) {
  const py::module_ numpy = py::module_::import("numpy");
  const py::object places =
      numpy.attr("arange")(s.states.size()).attr("reshape")(s.shape).attr("__getitem__")(index);
  const auto chosen = py::array_t < std::size_t, py::array::c_style | py::array::forcecast > ::ensure(places);
  if (!chosen) throw py::error_already_set();
  Kind result;
  result.eos = s.eos;
  result.restored = s.restored;
  result.shape = Shape(chosen.shape(), chosen.shape() + chosen.ndim());
  result.further.resize(s.further.size());
  for (py::ssize_t i = 0; i < chosen.size(); ++i) {
    const std::size_t place = chosen.data()[i];
    result.states.push_back(s.states[place]);
    for (std::size_t k = 0; k < s.further.size(); ++k) result.further[k].push_back(s.further[k][place]);
  }
  return result;
}

}  // namespace

std::optional<Numbers> numbers_of(const py::handle& argument) {
  if (!PyFloat_Check(argument.ptr()) && !PyLong_Check(argument.ptr())) {
    const py::module_ numpy = py::module_::import("numpy");
    if (numpy.attr("ma").attr("is_masked")(argument).cast<bool>()) {
      throw InputError(
          "masked values name no state: fill them, x.filled(numpy.nan) with skip_invalid=True, or leave them "
          "out, "
          "x.compressed()");
    }
    const auto array = py::array::ensure(argument);
    if (!array) {
      PyErr_Clear();
      return std::nullopt;
    }
    if (array.dtype().kind() == 'c') throw InputError("complex numbers name no state");
  }
  const auto numbers = Numbers::array_t::ensure(argument);
  if (!numbers) {
    PyErr_Clear();
    return std::nullopt;
  }
  return Numbers(numbers);
}

py::object read_only(const py::array& array) {
  py::object view = array.attr("view")();
  view.attr("setflags")(py::arg("write") = false);
  return view.attr("__getitem__")(py::tuple());
}

Points broadcast(std::initializer_list<OptionalNumbers> given) {
  Points points;
  for (const OptionalNumbers& numbers : given) {
    if (numbers) points.columns.push_back(*numbers);
  }
  if (points.columns.empty()) return points;
  const auto shape_of = [](const Numbers& a) { return Shape(a.shape(), a.shape() + a.ndim()); };
  points.shape = shape_of(points.columns.front());
  for (const Numbers& numbers : points.columns) {
    if (shape_of(numbers) == points.shape) continue;
    py::tuple arguments = py::cast(points.columns);
    const py::list equal = py::module_::import("numpy").attr("broadcast_arrays")(*arguments);
    for (std::size_t k = 0; k < points.columns.size(); ++k) points.columns[k] = Numbers(equal[k]);
    points.shape = shape_of(points.columns.front());
    break;
  }
  points.size = static_cast<std::size_t>(points.columns.front().size());
  return points;
}

py::object number_or_array(const py::array& array) { return array.attr("__getitem__")(py::tuple()); }

py::object array_of(const Shape& shape, const std::vector<double>& values) {
  return number_or_array(Numbers(shape, values.data()));
}

const eos::State& States::single() const {
  if (states.size() != 1) {
    throw InputError(fmt::format("expected one state, not {}: choose one by its index", states.size()));
  }
  return states.front();
}

void check_signals() {
  py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void add_states(py::module_& module) {
  py::class_<States> states(
      module, "States",
      "States of a material over an array of points.\n\n"
      "Each property is a read-only numpy array of the shape of the points, or a number for a\n"
      "single point, in SI units; NaN where the model does not carry the quantity.\n"
      "`states[index]` chooses points as numpy does.");
  for (const Property& p : properties) {
    const auto get = [member = p.member](const py::object& self) { return view(self, member); };
    states.def_property_readonly(p.name, py::cpp_function(get), p.meaning);
  }
  states
      .def_property_readonly("phase", &phases,
                             "Names of the phases: \"solid\", \"melting\", \"liquid\", \"vapour\", ...")
      .def_property_readonly(
          "shape", [](const States& s) { return py::tuple(py::cast(s.shape)); }, "Shape of the arrays.")
      .def("__getitem__", &subset<States>, py::arg("index"),
           "Choose points by an index, slice or mask of numpy.")
      .def(
          "__len__", [](const States& s) { return length_of(s.shape); },
          "Number of points along the first axis.")
      .def("__str__", &table_text)
      .def("__repr__", [](const States& s) {
        return fmt::format("<{} states of model {}>", s.states.size(), s.model());
      });
  static const std::vector<double eos::State::*> quantities = [] {
    std::vector<double eos::State::*> members;
    for (const Property& p : properties) members.push_back(p.member);
    return members;
  }();
  add_state_pickling<States>(states, quantities);
  const auto velocity = [](std::size_t place) {
    return [place](const States& s) { return further(s, place); };
  };
  py::class_<Shocks, States> shocks(module, "Shocks",
                                    "States behind steady shocks, with the velocities of the shocks.");
  add_state_pickling<Shocks>(shocks, quantities);
  shocks
      .def_property_readonly("shock_velocity", velocity(0),
                             "Velocity of the shock against the material ahead, m/s.")
      .def_property_readonly("particle_velocity", velocity(1),
                             "Velocity of the material behind the shock, m/s.")
      .def("__getitem__", &subset<Shocks>, py::arg("index"),
           "Choose points by an index, slice or mask of numpy.");
  py::class_<Isentropes, States> isentropes(module, "Isentropes", "States on an isentrope.");
  add_state_pickling<Isentropes>(isentropes, quantities);
  isentropes
      .def_property_readonly(
          "riemann_velocity", velocity(0),
          "Integral of c d(rho)/rho from the start of the isentrope, m/s; negative on expansion.")
      .def("__getitem__", &subset<Isentropes>, py::arg("index"),
           "Choose points by an index, slice or mask of numpy.");
  py::class_<Releases, States> releases(module, "Releases", "States after release to a pressure.");
  add_state_pickling<Releases>(releases, quantities);
  releases
      .def_property_readonly(
          "riemann_velocity", velocity(0),
          "Integral of c d(rho)/rho from the start, m/s; NaN of liquid and vapour in equilibrium.")
      .def_property_readonly("in_equilibrium", velocity(1),
                             "1 where the end is an equilibrium mixture of liquid and vapour, else 0.")
      .def("__getitem__", &subset<Releases>, py::arg("index"),
           "Choose points by an index, slice or mask of numpy.");
}

}  // namespace whipple::python
