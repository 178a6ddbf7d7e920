// SPDX-License-Identifier: BSD-3-Clause
// Melt at given temperature and pressure.
#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/phase.hpp"

namespace whipple::md {
namespace {

/// Threshold between a melt (below 0.1) and a crystal close to its melting point (about 0.5).
constexpr double largest_liquid_share = 0.25;

TaskResult compute_liquid(const Potential& potential, const RunSize& size, std::int64_t seed, double pressure,
                          double temperature) {
  TaskResult result;
  const double dt = time_step(potential, 1.0, temperature, size);
  const Phase phase =
      measure_phase(potential, true, pressure, temperature, size, dt, seed, result.transcript);
  const double mass = potential.mass();
  // Energies of a melt include the kinetic part of 3N degrees of freedom (equation 3).
  const double kinetic = 1.5 * metal::boltzmann * temperature;
  const auto energy = [&](const Estimate& e) {
    return Estimate{metal::specific_energy(e.value + kinetic, mass), metal::specific_energy(e.error, mass)};
  };
  const LiquidPoint point{.temperature = temperature,
                          .pressure = pressure,
                          .specific_volume = {metal::specific_volume(phase.volume.value, mass),
                                              metal::specific_volume(phase.volume.error, mass)},
                          .specific_enthalpy = energy(phase.enthalpy),
                          .specific_internal_energy = energy(phase.energy),
                          .crystal_share = phase.crystal_share,
                          .liquid = phase.crystal_share < largest_liquid_share};
  result.results = results_of(point);
  if (!point.liquid) result.message = "the melt froze";
  return result;
}

}  // namespace

void add_liquid(const Plan& plan, TaskList& list) {
  if (!plan.liquid) return;
  const RunSize size = plan.liquid->size;
  const Precision precision = precision_of(&LiquidPoint::specific_volume, true, plan.liquid->target, size);
  for (const double pressure : plan.liquid->pressure) {
    for (const double temperature : plan.liquid->temperature) {
      list.add({conditions_of(LiquidPoint{.temperature = temperature, .pressure = pressure}),
                size_settings(size),
                {},
                precision},
               [&potential = list.potential(), size, pressure, temperature](std::int64_t seed,
                                                                            const PointRecord*) {
                 return compute_liquid(potential, size, seed, pressure, temperature);
               });
    }
  }
}

}  // namespace whipple::md
