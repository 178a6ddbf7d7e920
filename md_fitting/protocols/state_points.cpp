// SPDX-License-Identifier: BSD-3-Clause
// Isotherms and isochores: points at constant volume and temperature.
#include <cmath>

#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/structure.hpp"

namespace whipple::md {
namespace {

void add_state(TaskList& list, double ratio, double temperature, const RunSize& size, const Target& target) {
  list.require_range(ratio);
  const double volume = ratio * list.potential().static_volume();
  list.add({conditions_of(StatePoint{.specific_volume = volume, .temperature = temperature}),
            size_settings(size),
            {},
            precision_of(&StatePoint::pressure, false, target, size)},
           [&potential = list.potential(), size, volume, temperature](std::int64_t seed, const PointRecord*) {
             NvtStateSource source(potential, size, seed);
             const State state = source.state(volume, temperature, StateSource::Effort::final);
             const double displacement =
                 std::sqrt(state.mean_square_displacement.value) / neighbour_distance(potential, volume);
             return TaskResult{
                 results_of(StatePoint{.specific_volume = volume,
                                       .temperature = temperature,
                                       .pressure = state.pressure,
                                       .specific_internal_energy = state.specific_internal_energy,
                                       .mean_square_displacement = state.mean_square_displacement,
                                       .error_correlation = state.correlation,
                                       .crystal_share = state.crystal_share,
                                       .solid = state.solid}),
                 structure_remark(state.crystal_share, state.solid, displacement),
                 source.transcript(),
                 {blocks_of(&StatePoint::pressure, state.pressure_blocks),
                  blocks_of(&StatePoint::specific_internal_energy, state.energy_blocks)}};
           });
}

}  // namespace

void add_isotherms(const Plan& plan, TaskList& list) {
  for (const IsothermPlan& isotherm : plan.isotherms) {
    for (const double ratio : isotherm.volume_ratio) {
      add_state(list, ratio, isotherm.temperature, isotherm.size, isotherm.target);
    }
  }
}

void add_isochores(const Plan& plan, TaskList& list) {
  for (const IsochorePlan& isochore : plan.isochores) {
    for (const double temperature : isochore.temperature) {
      add_state(list, isochore.volume_ratio, temperature, isochore.size, isochore.target);
    }
  }
}

}  // namespace whipple::md
