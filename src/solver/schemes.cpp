// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/simulation.hpp"

/// The time steps, one function per scheme. Numbers are equations of docs/theory/mpm.md; superscripts give
/// the time level of a quantity after the call.
namespace whipple::solver {

void step_symplectic(Simulation& s, double until) {
  s.begin_step(until);        // (6.1) dt from c, |v|, |a|
  s.bin_particles();          // blocks follow the matter
  s.map_particles_to_grid();  // (3.1)-(3.3) m, (mv)^n, f^n on nodes
  s.advance_grid();           // (3.4)-(3.5) v^{n+1} = v^n + dt f^n / m
  s.map_grid_to_particles();  // (4.2)-(4.8) v, C, x, e at n+1; grad v^{n+1}
  s.update_material(Simulation::EnergyUpdate::by_work_identity);  // stress, p, T, phase at n+1
  s.reflect_and_remove();                                         // walls; outflow is counted
  s.end_step();                                                   // ledger of energy and momentum
}

void step_musl(Simulation& s, double until) {
  s.begin_step(until);  // (6.1)
  s.bin_particles();
  s.map_particles_to_grid();                                           // (3.1)-(3.3)
  s.advance_grid();                                                    // (3.4)-(3.5)
  s.increment_particle_velocity();                                     // (5.1)-(5.2) v^{n+1}, displacement
  s.map_momentum_to_grid();                                            // (5.3) grid velocity from the new v
  s.gather_velocity_gradient();                                        // (5.4) at the old positions
  s.update_material(Simulation::EnergyUpdate::by_constitutive_model);  // stress and e at n+1
  s.move_particles();                                                  // (5.2) x^{n+1}
  s.reflect_and_remove();
  s.end_step();
}

}  // namespace whipple::solver
