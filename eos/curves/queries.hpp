// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/loci.hpp"

namespace whipple::eos::curves {

/// An equation of state with the name that tables and messages give it.
struct Subject {
  std::string name;
  std::shared_ptr<const EquationOfState> eos;
};
using Subjects = std::vector<Subject>;

/// The quantities (SI) that name a state: density with another one, or pressure with temperature; without any, the
/// reference state.
struct StateQuery {
  std::optional<double> density = {}, temperature = {}, energy = {}, pressure = {}, entropy = {};
};

/// The state of a query.
/// @throws InputError if the quantities do not name a state; StateError if the model has none
State state_of(const EquationOfState& eos, const StateQuery& query);

/// Where a Hugoniot begins: at the reference state, at porous material, or at a state shocked before.
struct HugoniotStart {
  std::optional<double> initial_density = {};  ///< kg/m^3, of porous material; the reference density at most
  std::optional<double> reflected_pressure = {};  ///< Pa: the Hugoniot begins at the state shocked to it
};

/// The Hugoniot from a start.
/// @throws InputError if the initial density is above the reference density
Hugoniot hugoniot_of(const EquationOfState& eos, const HugoniotStart& start);

/// The quantity (SI) that names a shocked state; none: no single state is asked for.
struct ShockQuery {
  std::optional<double> density = {}, pressure = {}, particle_velocity = {};
};

/// The shocked state of a query; none if it names no quantity.
/// @throws InputError if it names more than one; StateError if no shock leads there
std::optional<ShockState> shock_of(const Hugoniot& hugoniot, const ShockQuery& query);
/// The shocked state of a query.
/// @throws InputError if it does not name one quantity; StateError if no shock leads there
ShockState required_shock(const EquationOfState& eos, const HugoniotStart& start, const ShockQuery& query);

/// The interfaces that a shock passes when the first subject hits the second with a velocity (m/s), in their order.
/// @throws InputError for less than two subjects or a velocity that is not positive
std::vector<ImpedanceMatch> interfaces(const Subjects& subjects, double velocity);

}  // namespace whipple::eos::curves
