// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eos/curves/tables.hpp"
#include "src/material/material.hpp"

/// Reads the quantities of `whipple eos` from the command line and converts them to queries in SI units.
namespace whipple::app {

/// Holds the quantities as the user wrote them; empty: not given.
struct EosOptions {
  std::string density, temperature, energy, pressure, entropy, particle_velocity;
  std::string initial_density, reflected;
  std::string velocity;
  std::string from, to;
  std::string states;  ///< file with a list of states
  std::string volume;  ///< relative, of detonation products
  int points = 21;
};

/// Returns the value of an option in SI, if it is given. Densities and temperatures must be positive, velocities not
/// negative.
/// @throws InputError naming the option
std::optional<double> quantity(const char* option, const std::string& text, const char* unit);

// Queries of eos/curves from the options.
// @throws InputError that names the option
eos::curves::StateQuery state_query(const EosOptions& options);
/// Reads the states of `--states`, a CSV file with the quantities of the options as columns, "density [g/cm^3]" (no
/// unit: SI); without that option, returns the one state of the other options.
/// @throws InputError with file and line
std::vector<eos::curves::StateQuery> state_queries(const EosOptions& options);
eos::curves::HugoniotStart hugoniot_start(const EosOptions& options);
eos::curves::ShockQuery shock_query(const EosOptions& options);
/// Returns the variable of a curve whose unit is that of --to; the first variable if --to is not given.
eos::curves::Variable curve_variable(const EosOptions& options,
                                     std::span<const eos::curves::Variable> variables);
eos::curves::CurveRange curve_range(const EosOptions& options, eos::curves::Variable variable);
double impact_velocity(const EosOptions& options);

/// Refuses a foam (docs/theory/foam.md), which has no shock curve or isotherm of its equation of state alone.
/// @throws InputError
void refuse_foam(const Material& material);

/// Returns the equations of state of materials with their names.
eos::curves::Subjects subjects_of(std::span<const Material> materials);

}  // namespace whipple::app
