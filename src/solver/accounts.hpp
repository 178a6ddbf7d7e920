// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

#include "src/solver/ledger.hpp"

namespace whipple::solver {

/// Selects where a sum of the ledger is shown in addition to checkpoints, which hold all sums.
enum class Shown {
  nowhere,
  always,       ///< a column of history.csv
  of_elements,  ///< a column of history.csv in cases with elements
  of_damping,   ///< a column of history.csv in cases with local damping
  of_levels,    ///< the same in cases with two cell sizes
  limiter       ///< a column of history.csv: how often a bound of the material or the time step took effect
};

/// Returns whether a sum counts how often a bound or a warning took effect.
constexpr bool is_limiter(Shown shown) { return shown == Shown::limiter || shown == Shown::of_levels; }

/// Describes a sum that a run accumulates: one entry for the ledger, checkpoints, history.csv, the end of the log, the
/// report and the manual (docs/manual/output.md).
struct Account {
  const char* name;  ///< in checkpoints, and of the column of history.csv
  const char* unit;
  double Ledger::* sum;
  Shown shown;
  const char* meaning;
  /// Mechanism that removes energy from the motion, and its destination; empty for all other sums.
  std::string_view taken_by, taken_to;
  std::string_view reason;  ///< of a limiter: why the bound exists
};

// clang-format off
inline constexpr auto accounts = [] {
  using S = Ledger;
  using enum Shown;
  return std::to_array<Account>({
    {"external_work", "J", &S::external_work, nowhere, "work of external accelerations and of nodes with prescribed velocities", {}, {}, {}},
    {"damping_work", "J", &S::damping_work, of_damping, "work of local damping, which takes energy away: not positive", {}, {}, {}},
    {"work", "J", &S::work, nowhere, "work of the stress on the strain, into internal energy", {}, {}, {}},
    {"viscous_work", "J", &S::viscous_work, always, "work of the artificial viscosity, part of that of the stress",
     "artificial viscosity", "internal energy", {}},
    {"plastic_work", "J", &S::plastic_work, always, "plastic work, part of that of the stress",
     "plastic strain", "internal energy, stored cold work included", {}},
    {"dissipation", "J", &S::dissipation, always, "work that the material models made irreversible: plastic, viscous, lost with the strength",
     "the material models in all", "internal energy", {}},
    {"plastic_heat", "J", &S::plastic_heat, always, "heat of plastic flow without what it stores, of crushed pores, of elastic energy lost with the strength", {}, {}, {}},
    {"material_viscous_heat", "J", &S::material_viscous_heat, nowhere, "heat of viscous fluids and of relaxing stress", {}, {}, {}},
    {"transfer_heat", "J", &S::transfer_heat, always, "kinetic energy lost in transfers that became internal at once",
     "transfers between particles and grid", "internal energy", {}},
    {"unresolved_kept", "J", &S::unresolved_kept, always, "kinetic energy that became unresolved",
     "transfers and viscosity", "unresolved motion", {}},
    {"unresolved_returned", "J", &S::unresolved_returned, always, "unresolved energy that became internal",
     "unresolved motion where gaps close", "internal energy", {}},
    {"conducted_heat", "J", &S::conducted_heat, always, "internal energy conducted between particles in shocks",
     "conduction inside shocks", "moved between particles", {}},
    {"contact_heat", "J", &S::contact_heat, always, "kinetic energy lost by impulses of contact other than friction",
     "normal impulses between bodies and faces of cracks; at walls all impulses", "internal energy", {}},
    {"friction_heat", "J", &S::friction_heat, always, "kinetic energy lost by friction",
     "friction between bodies and faces of cracks", "internal energy", {}},
    {"contact_impulse", "N s", &S::contact_impulse, always, "sum of the normal impulses of contact", {}, {}, {}},
    {"friction_impulse", "N s", &S::friction_impulse, always, "sum of the tangential impulses of contact", {}, {}, {}},
    {"converted_mass", "kg", &S::converted_mass, of_elements, "mass of elements that became particles", {}, {}, {}},
    {"conversion_heat", "J", &S::conversion_heat, of_elements, "kinetic energy that conversions turned into internal energy",
     "conversion of elements to particles", "internal energy", {}},
    {"removed_mass", "kg", &S::removed_mass, of_elements, "mass of elements deleted beyond their valid range, part of outflow_mass", {}, {}, {}},
    {"hourglass_work", "J", &S::hourglass_work, of_elements, "work against hourglass forces",
     "hourglass forces", "hourglass and internal energy", {}},
    {"hourglass_overdrawn", "J", &S::hourglass_overdrawn, of_elements,
     "work that hourglass forces gave beyond what was stored, taken from internal energy", {}, {}, {}},
    {"below_cold_curve", "1", &S::below_cold_curve, limiter, "temperature held at the cold curve, energy kept", {}, {},
     "no state has an energy below that of the cold curve"},
    {"at_pressure_floor", "1", &S::at_pressure_floor, limiter, "pressure held at the minimum of a modifier `floor`", {}, {},
     "the material asks for it"},
    {"limited_volume_changes", "1", &S::limited_volume_changes, limiter, "volume ratio of a step limited to [1/2, 2]", {}, {},
     "the step is far too long for that particle"},
    {"limited_densities", "1", &S::limited_densities, limiter, "density limited to 1e-9 of the reference density", {}, {},
     "unconfined vapour fills the grid"},
    {"limited_compressions", "1", &S::limited_compressions, limiter,
     "density limited to 0.999 of the greatest of the equation of state", {}, {},
     "single particles at the edge of a contact, or in rings that converge on the axis; more than one of a body in a thousand ends the run"},
    {"limited_void_steps", "1", &S::limited_void_steps, limiter, "volume change of material with an open void limited to a tenth", {}, {},
     "relaxation to zero pressure is linearised"},
    {"limited_bulking", "1", &S::limited_bulking, limiter, "bulking of crushed brittle material limited", {}, {},
     "its pressure would be unbounded"},
    {"limited_domains", "1", &S::limited_domains, limiter, "domain of a particle limited to what its shape function takes", {}, {},
     "domains follow the strain"},
    {"limited_hourglass", "1", &S::limited_hourglass, limiter,
     "hourglass forces of an element limited to its stored energy, by more than a hundredth", {}, {},
     "the element lengthened along them, or lost stiffness: they would return more than was stored"},
    {"elements_beyond_range", "1", &S::elements_beyond_range, limiter,
     "element left the range of `[body.element_range]` and became particles or was deleted", {}, {},
     "its strain is no approximation of that of the material"},
    {"held_pressures", "1", &S::held_pressures, limiter,
     "pressure held back in a fluid particle that has parted from its neighbours", {}, {},
     "a particle without neighbours would lose its heat to itself; more `splitting.maximum_generations` make them fewer"},
    {"refused_divisions", "1", &S::refused_divisions, limiter,
     "division of a particle refused at splitting.maximum_particles, in every step again", {}, {},
     "memory is finite"},
    {"held_time_steps", "1", &S::held_time_steps, limiter,
     "time step kept longer than `time.compression_limit` asks for, at least an eighth of the stable one", {}, {},
     "a few compressed particles must not govern a run"},
    {"shocks_at_change", "1", &S::shocks_at_change, of_levels,
     "particle with functions of two cell sizes under a pressure above a tenth of rho0 c0^2", {}, {},
     "a strong shock that crosses a change of the cell size leaves wrong heat: `domain.refinement` should hold it"},
  });
}();
// clang-format on

/// Ensures that every sum of the ledger is an account; a sum without one would be neither added up, saved nor shown.
static_assert(sizeof(Ledger) == 2 * sizeof(Totals) + sizeof(BodyOutflow) + 2 * sizeof(Vector3) +
                                    (accounts.size() + 3) * sizeof(double));

/// Calls f(name, number) for every number of the ledger.
template <class L, class Function>
  requires std::same_as<std::remove_const_t<L>, Ledger>
void for_each_number(L& ledger, Function&& f) {
  for_each_number(ledger.initial, [&](const std::string& name, auto& x) { f("initial_" + name, x); });
  for_each_number(ledger.outflow, [&](const std::string& name, auto& x) { f("outflow_" + name, x); });
  f("retired_mass", ledger.retired.mass);
  f("retired_momentum_x", ledger.retired.momentum[0]);
  f("retired_momentum_y", ledger.retired.momentum[1]);
  f("retired_momentum_z", ledger.retired.momentum[2]);
  f("retired_energy", ledger.retired.energy);
  f("wall_impulse_x", ledger.wall_impulse[0]);
  f("wall_impulse_y", ledger.wall_impulse[1]);
  f("wall_impulse_z", ledger.wall_impulse[2]);
  f("external_impulse_x", ledger.external_impulse[0]);
  f("external_impulse_y", ledger.external_impulse[1]);
  f("external_impulse_z", ledger.external_impulse[2]);
  for (const Account& account : accounts) f(account.name, ledger.*account.sum);
  f("largest_kinetic_energy", ledger.largest_kinetic_energy);
  f("largest_heating", ledger.largest_heating);
  f("largest_momentum", ledger.largest_momentum);
}

}  // namespace whipple::solver
