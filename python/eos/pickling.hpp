// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "python/eos/states.hpp"
#include "src/material/material.hpp"

/// Implements copying and pickling of the module's objects, for multiprocessing and for files.
namespace whipple::python {

/// Returns a text as Python represents paths: bytes that are not UTF-8 as lone surrogates, as os.fsdecode.
py::str with_paths(const std::string& text);

/// Wraps a material with the content of its pickle: the function that recreates it, and its arguments.
py::object with_recipe(Material material, const py::object& function, const py::tuple& arguments);

/// Declares __copy__, __deepcopy__ and __reduce__ of materials, and the function called when unpickling.
void add_material_pickling(py::module_& module, py::class_<Material>& material);

/// Returns a material of a file, with the recipe that reads it again.
py::object material_of_file(Material material,
                            const std::vector<std::pair<std::string, std::string>>& changes);

/// Returns the content of a pickle of states: shape, quantities in the order of `quantities`, phases, further
/// columns, model.
py::tuple packed(const States& states, std::span<double eos::State::* const> quantities);
/// Restores states of a pickle; they own the names of their phases and have no material.
void unpack(States& states, const py::tuple& pack, std::span<double eos::State::* const> quantities);

/// Declares copies and pickles of a class of states.
template <class Kind, class Class>
void add_state_pickling(Class& declared, std::span<double eos::State::* const> quantities) {
  declared.def("__copy__", [](const Kind& states) { return Kind(states); })
      .def("__deepcopy__", [](const Kind& states, const py::dict&) { return Kind(states); })
      .def(py::pickle([quantities](const Kind& states) { return packed(states, quantities); },
                      [quantities](const py::tuple& pack) {
                        Kind states;
                        unpack(states, pack, quantities);
                        return states;
                      }));
}

}  // namespace whipple::python
