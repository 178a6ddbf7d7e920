// SPDX-License-Identifier: BSD-3-Clause
// Points of the Hugoniot: `solve_hugoniot` on molecular dynamics.
#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/hugoniot.hpp"
#include "md_fitting/protocols/hugoniot_guess.hpp"
#include "md_fitting/protocols/nvt_state.hpp"

namespace whipple::md {
namespace {

TaskResult compute_hugoniot(const Potential& potential, const RunSize& size, std::int64_t seed, double volume,
                            const PointRecord& zero_pressure) {
  const ReferenceState reference = reference_state(zero_pressure);
  NvtStateSource source(potential, size, seed);
  HugoniotSearch search;
  search.specific_heat = 3.0 * metal::specific_energy(metal::boltzmann, potential.mass());
  search.gruneisen = 2.0 * volume / reference.specific_volume.value;
  search.first_temperature = guess_hugoniot(potential, reference, volume).temperature;
  const HugoniotState state = solve_hugoniot(source, reference, volume, search);
  return {results_of<HugoniotPoint>(state),
          structure_remark(state.crystal_share, state.solid),
          source.transcript(),
          {blocks_of(&HugoniotPoint::pressure, state.pressure_blocks)}};
}

}  // namespace

void add_hugoniot(const Plan& plan, TaskList& list) {
  if (!plan.hugoniot) return;
  const RunSize size = plan.hugoniot->size;
  for (const double ratio : plan.hugoniot->volume_ratio) {
    list.require_range(ratio);
    const double volume = ratio * list.potential().static_volume();
    list.add({conditions_of(HugoniotPoint{.specific_volume = volume}), size_settings(size),
              list.first_key(ZeroPressurePoint::protocol),
              precision_of(&HugoniotPoint::shock_velocity, true, plan.hugoniot->target, size)},
             [&potential = list.potential(), size, volume](std::int64_t seed, const PointRecord* reference) {
               return compute_hugoniot(potential, size, seed, volume, *reference);
             });
  }
}

}  // namespace whipple::md
