// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/loci.hpp"

namespace whipple::eos::curves {

/// Holds an equation of state with its name in tables and messages.
struct Subject {
  std::string name;
  std::shared_ptr<const EquationOfState> eos;
};
using Subjects = std::vector<Subject>;

/// Holds the quantities (SI) that specify a state: density with another one, or pressure with temperature; without
/// any, the reference state.
struct StateQuery {
  std::optional<double> density = {}, temperature = {}, energy = {}, pressure = {}, entropy = {};
};

/// Returns the state of a query.
/// @throws InputError if the quantities do not specify a state; StateError if the model has none
State state_of(const EquationOfState& eos, const StateQuery& query);

/// Specifies the initial state of a Hugoniot: the reference state, porous material, or a previously shocked state.
struct HugoniotStart {
  std::optional<double> initial_density = {};  ///< kg/m^3, of porous material; at most the reference density
  std::optional<double> reflected_pressure = {};  ///< Pa: start at the state shocked to this pressure
};

/// Returns the Hugoniot from an initial state.
/// @throws InputError if the initial density is above the reference density
Hugoniot hugoniot_of(const EquationOfState& eos, const HugoniotStart& start);

/// Holds the quantity (SI) that specifies a shocked state; none: no single state is requested.
struct ShockQuery {
  std::optional<double> density = {}, pressure = {}, particle_velocity = {};
};

/// Returns the shocked state of a query; none if it specifies no quantity.
/// @throws InputError if it specifies more than one; StateError if no shock leads to it
std::optional<ShockState> shock_of(const Hugoniot& hugoniot, const ShockQuery& query);
/// Returns the shocked state of a query.
/// @throws InputError if it does not specify exactly one quantity; StateError if no shock leads to it
ShockState required_shock(const EquationOfState& eos, const HugoniotStart& start, const ShockQuery& query);

/// Returns the interfaces passed by a shock when the first subject hits the second with a velocity (m/s), in order.
/// @throws InputError for fewer than two subjects or a velocity that is not positive
std::vector<ImpedanceMatch> interfaces(const Subjects& subjects, double velocity);

}  // namespace whipple::eos::curves
