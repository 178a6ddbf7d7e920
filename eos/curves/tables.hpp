// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "eos/curves/queries.hpp"
#include "eos/curves/table.hpp"
#include "eos/loci/detonation_products.hpp"

namespace whipple::eos::curves {

/// Quantities that a curve may run over.
enum class Variable {
  pressure,           ///< Pa
  particle_velocity,  ///< m/s
  density,            ///< kg/m^3
};

/// Ends (SI) and number of points of a curve; what is missing follows from the curve.
struct CurveRange {
  std::optional<double> from = {}, to = {};
  int points = 21;
};

// One table of several subjects. Where the model of a subject ends on the way, its curve ends with the reason
// (`Series::end`); StateError if it has no point at all, InputError if the quantities contradict each other.

/// The states of queries, in their order, of each subject.
CurveTable state_table(const Subjects& subjects, std::span<const StateQuery> queries);
/// Hugoniots over pressure (from zero to 200 GPa) or particle velocity, or the one shocked state of a query.
CurveTable hugoniot_table(const Subjects& subjects, const HugoniotStart& start, const ShockQuery& query,
                          Variable variable, const CurveRange& range);
/// Isotherms over pressure, from zero to 100 GPa.
/// @param temperature  K; missing: the reference temperature of each model
CurveTable isotherm_table(const Subjects& subjects, std::optional<double> temperature,
                          const CurveRange& range);
/// Isentropes from a state to a pressure (100 GPa) or a density, at equal ratios of density.
CurveTable isentrope_table(const Subjects& subjects, const StateQuery& start, Variable variable,
                           const CurveRange& range);
/// Release of a shocked state to a pressure (zero): along the isentrope, or of one point where it is in equilibrium
/// of liquid and vapour.
CurveTable release_table(const Subjects& subjects, const HugoniotStart& start, const ShockQuery& query,
                         const CurveRange& range);
/// Cold curves over density, from 0.9 to 1.5 of the reference density.
CurveTable cold_table(const Subjects& subjects, const CurveRange& range);
/// Solidus and liquidus over pressure, from zero to 100 GPa.
CurveTable melt_table(const Subjects& subjects, const CurveRange& range);
/// Liquid and vapour in equilibrium, at equal ratios of pressure from 100 Pa to the critical point.
CurveTable dome_table(const Subjects& subjects, const CurveRange& range);
/// Impact of the first subject on the second with a velocity (m/s), and the shock transmitted into the others.
CurveTable match_table(const Subjects& subjects, double velocity);

// Explosives: equations of state of detonation products; InputError for others.

/// The Chapman-Jouguet state of each, with detonation velocity, adiabatic exponent and Gurney velocity.
CurveTable detonation_table(const Subjects& explosives);
/// Isentropes of products from the Chapman-Jouguet state down to a pressure or density (the hundredfold volume of the
/// explosive), with the part of the energy of the explosive that they still hold.
CurveTable products_table(const Subjects& explosives, Variable variable, const CurveRange& range);
/// The detonation wave of the first subject meets each of the others at normal incidence.
CurveTable contact_table(const Subjects& explosive_and_inert);
/// Gurney's speeds of driven metal over the ratio of masses M/C, from 0.1 to 10 at equal ratios.
/// @param volume  relative volume to which the products drive
CurveTable gurney_table(const Subjects& explosives, double volume, int points);
/// Wall of a cylinder test over its displacement, from 1 to 25 mm.
CurveTable cylinder_table(const Subjects& explosives, const CylinderTest& test, const CurveRange& range);

}  // namespace whipple::eos::curves
