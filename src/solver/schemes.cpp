// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/simulation.hpp"

/// The time steps, one function per scheme. Numbers are equations of docs/theory/mpm.md; superscripts give
/// the time level of a quantity after the call.
namespace whipple::solver {

void step_symplectic(Simulation& s, double until) {
  s.adapt_elements();          // distorted elements become particles (docs/theory/afemp.md)
  s.begin_step(until);         // (6.1) dt from c, |v|, |a|
  s.split_particles();         // (2.5)-(2.7) if asked for
  s.compute_element_forces();  // f^n of elements on their nodes (docs/theory/fem.md)
  s.bin_particles();           // blocks follow the material
  s.conduct_heat();            // e, if the case asks for it (docs/theory/conduction.md)
  s.map_particles_to_grid();   // (3.1)-(3.3) m, (mv)^n, f^n on nodes
  s.advance_grid();            // (3.4)-(3.5) v^{n+1} = v^n + dt f^n / m
  s.map_grid_to_particles();   // (4.2)-(4.8) v, C, x, e at n+1; by grad v^{n+1} stress, p, T, phase
  s.advance_elements();        // the same of nodes and elements (docs/theory/afemp.md)
  s.reflect_and_remove();      // walls; outflow is counted
  s.end_step();                // ledger of energy and momentum
}

void step_usf(Simulation& s, double until) {
  s.begin_step(until);  // (6.1)
  s.split_particles();
  s.bin_particles();
  s.conduct_heat();
  s.map_momentum_to_grid();      // (5.5) v^n on nodes
  s.update_material();           // (5.6) grad v^n, by it stress and e
  s.map_particles_to_grid();     // (3.1)-(3.3) with the new stress
  s.advance_grid();              // (3.4), (5.9)
  s.update_particle_velocity();  // (5.1)-(5.2) v, x at n+1
  s.reflect_and_remove();
  s.end_step();
}

void step_usl(Simulation& s, double until) {
  s.begin_step(until);  // (6.1)
  s.split_particles();
  s.bin_particles();
  s.conduct_heat();
  s.map_particles_to_grid();         // (3.1)-(3.3)
  s.advance_grid();                  // (3.4), (5.9)
  s.update_velocity_and_material();  // (5.1)-(5.2) v, x at n+1; (5.7) by grad v^{n+1} stress, e
  s.reflect_and_remove();
  s.end_step();
}

void step_musl(Simulation& s, double until) {
  s.begin_step(until);  // (6.1)
  s.split_particles();
  s.bin_particles();
  s.conduct_heat();
  s.map_particles_to_grid();     // (3.1)-(3.3)
  s.advance_grid();              // (3.4), (5.9)
  s.update_particle_velocity();  // (5.1)-(5.2) v, x at n+1; the grid sees the places of `bin_particles`
  s.map_momentum_to_grid();      // (5.3) grid velocity from the new v
  s.update_material();           // (5.4) grad v at the old places, by it stress and e
  s.reflect_and_remove();
  s.end_step();
}

}  // namespace whipple::solver
