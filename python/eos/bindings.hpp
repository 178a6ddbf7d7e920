// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "src/material/material.hpp"

namespace whipple::python {

/// Declares shock, release and phase curves, impacts, mixtures and comparisons: methods of the material and
/// functions of the module.
void add_loci(pybind11::module_& module, pybind11::class_<Material>& material);

/// Declares detonation products: a method of the material, its result types, and Gurney velocities.
void add_explosives(pybind11::module_& module, pybind11::class_<Material>& material);

}  // namespace whipple::python
