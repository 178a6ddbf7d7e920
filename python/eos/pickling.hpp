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

/// Copies and pickles of what the module returns, for multiprocessing and for files.
namespace whipple::python {

/// A text as Python has paths: bytes that are not UTF-8 as lone surrogates, as os.fsdecode.
py::str with_paths(const std::string& text);

/// Wraps a material with what its pickle holds: the function that makes it again, and its arguments.
py::object with_recipe(Material material, const py::object& function, const py::tuple& arguments);

/// Declares __copy__, __deepcopy__ and __reduce__ of materials, and the function that their pickles call.
void add_material_pickling(py::module_& module, py::class_<Material>& material);

/// A material of a file, with the recipe that reads it again.
py::object material_of_file(Material material,
                            const std::vector<std::pair<std::string, std::string>>& changes);

/// What a pickle of states holds: shape, quantities in the order of `quantities`, phases, further columns, model.
py::tuple packed(const States& states, std::span<double eos::State::* const> quantities);
/// States of a pickle; they own the names of their phases and belong to no material.
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
