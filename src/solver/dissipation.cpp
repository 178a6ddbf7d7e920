// SPDX-License-Identifier: BSD-3-Clause
// What becomes of the kinetic energy that the transfers lose, and heat inside shocks
// (docs/theory/dissipation.md).
#include <algorithm>

#include "src/solver/simulation.hpp"

namespace whipple::solver {

void Simulation::set_up_dissipation() {
  const cases::Dissipation& control = setup_.dissipation;
  initial_density_.clear();
  shock_conductivity_.clear();
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    const eos::State& reference = setup_.materials[b]->reference;
    const cases::ArtificialViscosity& viscosity = setup_.viscosity_of(b);
    initial_density_.push_back(setup_.bodies[b].initial.of(*setup_.materials[b]).density);
    shock_conductivity_.push_back({.heat_capacity = std::max(reference.heat_capacity, 0.0),
                                   .linear_viscosity = viscosity.linear,
                                   .quadratic_viscosity = viscosity.quadratic});
  }
  losses_ = {.kept = control.keeps_losses(),
             .heat_share = control.heat_share,
             .collision_rate = control.collision_rate,
             .initial_density = initial_density_};
}

void Simulation::conduct_in_shocks() {
  const cases::Dissipation& control = setup_.dissipation;
  if (!control.keeps_losses() || !(control.shock_conduction > 0.0)) return;
  profile_.time("conduction", [&] {
    step_.conducted_heat += transfer::conduct_in_shocks(
        shape_, particles_, grid_, state_.time_step,
        {control.shock_conduction, control.conduction_onset, control.conduction_rise, shock_conductivity_});
  });
}

}  // namespace whipple::solver
