// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "eos/curves/queries.hpp"
#include "eos/curves/table.hpp"
#include "eos/loci/detonation_products.hpp"

namespace whipple::eos::curves {

/// Lists the independent variables of curves.
enum class Variable {
  pressure,           ///< Pa
  particle_velocity,  ///< m/s
  density,            ///< kg/m^3
};

/// Holds the ends (SI) and number of points of a curve; missing ends are derived from the curve.
struct CurveRange {
  std::optional<double> from = {}, to = {};
  int points = 21;
};

// Each function returns one table for several subjects. Where a model is no longer valid, its curve is truncated
// and the reason is stored in `Series::end`; StateError if it has no point at all, InputError if the quantities
// contradict each other.

/// Tabulates the states of queries, in order, for each subject.
CurveTable state_table(const Subjects& subjects, std::span<const StateQuery> queries);
/// Tabulates Hugoniots over pressure (from zero to 200 GPa) or particle velocity, or the single shocked state of a
/// query.
CurveTable hugoniot_table(const Subjects& subjects, const HugoniotStart& start, const ShockQuery& query,
                          Variable variable, const CurveRange& range);
/// Tabulates isotherms over pressure, from zero to 100 GPa.
/// @param temperature  K; missing: the reference temperature of each model
CurveTable isotherm_table(const Subjects& subjects, std::optional<double> temperature,
                          const CurveRange& range);
/// Tabulates isentropes from a state to a pressure (100 GPa) or a density, at equal ratios of density.
CurveTable isentrope_table(const Subjects& subjects, const StateQuery& start, Variable variable,
                           const CurveRange& range);
/// Tabulates the release of a shocked state to a pressure (zero): along the isentrope, or as a single point in
/// liquid-vapour equilibrium.
CurveTable release_table(const Subjects& subjects, const HugoniotStart& start, const ShockQuery& query,
                         const CurveRange& range);
/// Tabulates cold curves over density, from 0.9 to 1.5 of the reference density.
CurveTable cold_table(const Subjects& subjects, const CurveRange& range);
/// Tabulates solidus and liquidus over pressure, from zero to 100 GPa.
CurveTable melt_table(const Subjects& subjects, const CurveRange& range);
/// Tabulates liquid and vapour in equilibrium, at equal ratios of pressure from 100 Pa to the critical point.
CurveTable dome_table(const Subjects& subjects, const CurveRange& range);
/// Tabulates the impact of the first subject on the second with a velocity (m/s), and the shocks transmitted into
/// the others.
CurveTable match_table(const Subjects& subjects, double velocity);

// Explosives: equations of state of detonation products; InputError for others.

/// Tabulates the Chapman-Jouguet state of each, with detonation velocity, adiabatic exponent and Gurney velocity.
CurveTable detonation_table(const Subjects& explosives);
/// Tabulates isentropes of products from the Chapman-Jouguet state down to a pressure or density (default: a
/// hundred times the volume of the explosive), with the remaining fraction of the energy of the explosive.
CurveTable products_table(const Subjects& explosives, Variable variable, const CurveRange& range);
/// Tabulates the interaction of the detonation wave of the first subject with each of the others at normal incidence.
CurveTable contact_table(const Subjects& explosive_and_inert);
/// Tabulates Gurney velocities of driven metal over the mass ratio M/C, from 0.1 to 10 at equal ratios.
/// @param volume  relative volume up to which the products drive the metal
CurveTable gurney_table(const Subjects& explosives, double volume, int points);
/// Tabulates the wall motion of a cylinder test over its displacement, from 1 to 25 mm.
CurveTable cylinder_table(const Subjects& explosives, const CylinderTest& test, const CurveRange& range);

}  // namespace whipple::eos::curves
