// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eos/curves/tables.hpp"
#include "src/material/material.hpp"

/// The quantities of `whipple eos` on the command line, and what they ask for in SI.
namespace whipple::app {

/// Quantities as the user wrote them; empty: not given.
struct EosOptions {
  std::string density, temperature, energy, pressure, entropy, particle_velocity;
  std::string initial_density, reflected;
  std::string velocity;
  std::string from, to;
  std::string states;  ///< file with a list of states
  std::string volume;  ///< relative, of detonation products
  int points = 21;
};

/// The value of an option in SI, if it is given; errors name the option. Densities and temperatures must be
/// positive, velocities not negative.
/// @throws InputError
std::optional<double> quantity(const char* option, const std::string& text, const char* unit);

// What the options ask of eos/curves.
// @throws InputError that names the option
eos::curves::StateQuery state_query(const EosOptions& options);
/// Reads the states of `--states`, a CSV file with the quantities of the options as columns, "density [g/cm^3]" (no unit:
/// SI); the one state of the other options without it.
/// @throws InputError with file and line
std::vector<eos::curves::StateQuery> state_queries(const EosOptions& options);
eos::curves::HugoniotStart hugoniot_start(const EosOptions& options);
eos::curves::ShockQuery shock_query(const EosOptions& options);
/// The variable of a curve is that of which --to has the unit, the first one without --to.
eos::curves::Variable curve_variable(const EosOptions& options,
                                     std::span<const eos::curves::Variable> variables);
eos::curves::CurveRange curve_range(const EosOptions& options, eos::curves::Variable variable);
double impact_velocity(const EosOptions& options);

/// The equations of state of materials, under their names.
eos::curves::Subjects subjects_of(std::span<const Material> materials);

}  // namespace whipple::app
