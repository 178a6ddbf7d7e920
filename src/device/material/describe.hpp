// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/device/material/material_constants.hpp"
#include "src/material/material.hpp"
#include "src/material/update.hpp"

/// Describes materials for kernels of a graphics processor, on the host.
namespace whipple::device {

/// Lists what a kernel does not compute of a material: a sentence each that names the material, the key and what is accepted.
/// Empty: all of it.
std::vector<std::string> refusals(const Material& material);

/// Returns whether a kernel has the equation of state of a material neither in closed form nor as a table.
bool needs_table(const Material& material);

/// Returns the constants of a material and of the artificial viscosity of a body of it. Time step, time and burn of the
/// settings do not matter; `lengths` of single points are not taken.
/// @param tables  numbers of all materials, to which those of its equation of state are appended
/// @throws InputError with the refusals
MaterialConstants describe(const Material& material, const UpdateSettings& settings,
                           std::vector<double>& tables);

/// Returns the material with a table in place of its equation of state, with a requested error of `error`
/// (eos/table/builder.hpp). Several seconds of work for models with phases.
/// @throws InputError if the model cannot be tabulated
Material tabulated(const Material& material, double error = 1e-4);

}  // namespace whipple::device
