// SPDX-License-Identifier: BSD-3-Clause
// The points of the Hugoniot: `solve_hugoniot` on molecular dynamics.
#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/hugoniot.hpp"
#include "md_fitting/protocols/nvt_state.hpp"

namespace whipple::md {
namespace {

/// Temperature behind the shock from the static crystal's energy curve and a harmonic solid with Grueneisen
/// coefficient 2 V/V0 (equation 10): good to about a tenth, enough to begin with.
double first_hugoniot_temperature(const Potential& potential, const ReferenceState& reference,
                                  double volume) {
  const double mass = potential.mass();
  const int atoms = potential.tables().atoms_per_cell();
  const auto cold_energy = [&](double v) {
    return metal::specific_energy(
        potential.tables().crystal_energy(std::cbrt(metal::volume_per_atom(v, mass) * atoms)), mass);
  };
  const double dv = 1e-3 * volume;
  const double cold_pressure = -(cold_energy(volume + dv) - cold_energy(volume - dv)) / (2 * dv);
  const double heat = 3.0 * metal::specific_energy(metal::boltzmann, mass);
  const double half = 0.5 * (reference.specific_volume.value - volume);
  const double gruneisen = 2.0 * volume / reference.specific_volume.value;
  const double t = (half * cold_pressure - cold_energy(volume) + reference.specific_internal_energy.value) /
                   (heat * (1.0 - gruneisen * half / volume));
  return std::fmax(t, 100.0);
}

TaskResult compute_hugoniot(const Potential& potential, const RunSize& size, std::int64_t seed, double volume,
                            const PointRecord& zero_pressure) {
  const ReferenceState reference{zero_pressure.result("specific_volume"),
                                 zero_pressure.result("specific_internal_energy"),
                                 zero_pressure.condition("pressure")};
  NvtStateSource source(potential, size, seed);
  HugoniotSearch search;
  search.specific_heat = 3.0 * metal::specific_energy(metal::boltzmann, potential.mass());
  search.gruneisen = 2.0 * volume / reference.specific_volume.value;
  search.first_temperature = first_hugoniot_temperature(potential, reference, volume);
  const HugoniotState state = solve_hugoniot(source, reference, volume, search);
  return {{{"pressure", state.pressure},
           {"temperature", state.temperature},
           {"specific_internal_energy", state.specific_internal_energy},
           {"shock_velocity", state.shock_velocity},
           {"particle_velocity", state.particle_velocity},
           {"mean_square_displacement", state.mean_square_displacement},
           {"solid", {state.solid ? 1.0 : 0.0, 0.0}}},
          melting_remark(state.solid),
          source.transcript()};
}

}  // namespace

void add_hugoniot(const Plan& plan, TaskList& list) {
  if (!plan.hugoniot) return;
  const RunSize size = plan.hugoniot->size;
  for (const double ratio : plan.hugoniot->volume_ratio) {
    list.require_range(ratio);
    const double volume = ratio * list.potential().static_volume();
    list.add({{{"specific_volume", volume}}, size_settings(size), list.first_key("zero_pressure_volume")},
             [&potential = list.potential(), size, volume](std::int64_t seed, const PointRecord* reference) {
               return compute_hugoniot(potential, size, seed, volume, *reference);
             });
  }
}

}  // namespace whipple::md
