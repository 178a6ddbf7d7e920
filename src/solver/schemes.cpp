// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <ranges>

#include "src/solver/carriers/domains.hpp"
#include "src/solver/stages.hpp"

/// The time steps, one function per scheme. Numbers are equations of docs/theory/mpm.md; superscripts give
/// the time level of a quantity after the call. Ranks exchange the nodes of their borders where it says `send` and
/// `receive`: called in the middle of a transfer, so that the interior is worked on in between.
namespace whipple::solver {
namespace {

using Energy = MaterialStage::Energy;
using Take = transfer::TakeGradients;

/// Sends the sums at the nodes of the border, mass, momentum and forces, to the ranks that own them.
std::function<void()> send_sums(Stages& s) {
  return [&s] { s.transfers.send_sums(); };
}
/// Sends mass and momentum only.
std::function<void()> send_momentum(Stages& s) {
  return [&s] { s.transfers.send_momentum(); };
}
/// Receives the results at the nodes of the border from the ranks that own them.
std::function<void()> receive(Stages& s) {
  return [&s] { s.transfers.receive(); };
}
/// Applies contact between bodies.
std::function<void()> contact(Stages& s) {
  return [&s] { s.contact.apply(); };
}

/// dt = the least of its bounds (6.1), then the domain of particles that are too long is divided if asked for (2.5).
void begin_step(Stages& s, double until) {
  s.time_step.begin(until);
  s.contact.watch_touches(s.time_step.accurate_step());
  domains::split(s.state, s.carriers, s.particles);
}

/// Heat that is conducted, if the case asks for it (docs/theory/conduction.md): in shocks, and between particles.
void conduct_heat(Stages& s) {
  s.transfers.conduct_in_shocks();
  if (!s.state.setup.heat.conduction) return;
  s.contact.find_surfaces(false);
  s.transfers.conduct_heat(s.contact.touch_at_node());
}

/// Surfaces that contact needs, from masses on the nodes.
void find_surfaces(Stages& s) {
  s.contact.find_surfaces(true);
  s.contact.find_surfaces_at_walls();
}

/// Velocity and position of particles apart from their material.
void move_particles(Stages& s) {
  s.state.profile.time("grid to particles", [&] { s.transfers.velocity_to_particles({}, receive(s)); });
}

/// Ledger of energy and momentum, and what the next step is bounded by.
void end_step(Stages& s) {
  s.state.profile.time("boundaries", [&] {
    // Elements first: the outflow is summed in this order.
    for (Carrier* carrier : s.carriers | std::views::drop(1)) carrier->remove_outside();
    s.particles.remove_outside();
    s.particles.retire_products();
  });
  s.state.profile.time("ledger", [&] {
    RunState& run = s.state.run;
    s.time_step.take_rates();
    s.balance.sum();
    run.ledger.observe(s.state.totals);
    ++run.step;
    run.time += run.time_step;
    s.contact.foresee_touches(s.time_step.accurate_step());
    s.balance.require_energy();
    s.plausibility.require();
  });
}

/// Symplectic scheme with exact energy (docs/theory/mpm.md, section 4).
void step_symplectic(Stages& s, double until) {
  s.elements.adapt(s.contact.has_fields());  // distorted elements become particles (docs/theory/afemp.md)
  begin_step(s, until);                      // (6.1) dt from c, |v|, |a|; (2.5)-(2.7)
  s.elements.compute_forces();               // f^n of elements on their nodes (docs/theory/fem.md)
  bin_particles(s);                          // blocks follow the material
  conduct_heat(s);                           // e
  s.transfers.to_grid(send_sums(s));         // (3.1)-(3.3) m, (mv)^n, f^n on nodes
  find_surfaces(s);
  s.transfers.advance_grid(contact(s));  // (3.4)-(3.5) v^{n+1} = v^n + dt f^n / m, then contact of bodies
  s.transfers.apply_full_mass_matrix();
  s.material.update("grid to particles", Energy::by_work_identity, [&](const Take& take) {
    s.transfers.to_particles(
        take, receive(s));  // (4.2)-(4.8) v, C, x, e at n+1; by grad v^{n+1} stress, p, T, phase
  });
  s.elements.advance();  // the same of nodes and elements
  end_step(s);           // walls and outflow; energy and momentum
}

/// Update stress first (Bardenhagen, J. Comput. Phys. 180 (2002) 383; docs/theory/mpm.md, 5).
void step_usf(Stages& s, double until) {
  begin_step(s, until);  // (6.1)
  bin_particles(s);
  conduct_heat(s);
  s.contact.find_surfaces_at_walls();  // not from this step, in which the grid has not been advanced
  s.transfers.momentum_to_grid(send_momentum(s));  // (5.5) v^n on nodes
  s.material.update("velocity gradient", Energy::by_constitutive_model, [&](const Take& take) {
    s.transfers.gradient_to_particles(take, receive(s));  // (5.6) grad v^n, by it stress and e
  });
  s.transfers.to_grid(send_sums(s));  // (3.1)-(3.3) with the new stress
  find_surfaces(s);
  s.transfers.advance_grid(contact(s));  // (3.4), (5.9)
  s.transfers.apply_full_mass_matrix();
  move_particles(s);  // (5.1)-(5.2) v, x at n+1
  end_step(s);
}

/// Update stress last (Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Eng. 118 (1994) 179;
/// docs/theory/mpm.md, 5).
void step_usl(Stages& s, double until) {
  begin_step(s, until);  // (6.1)
  bin_particles(s);
  conduct_heat(s);
  s.transfers.to_grid(send_sums(s));  // (3.1)-(3.3)
  find_surfaces(s);
  s.transfers.advance_grid(contact(s));  // (3.4), (5.9)
  s.transfers.apply_full_mass_matrix();
  s.material.update("grid to particles", Energy::by_constitutive_model, [&](const Take& take) {
    s.transfers.velocity_to_particles(
        take, receive(s));  // (5.1)-(5.2) v, x at n+1; (5.7) by grad v^{n+1} stress, e
  });
  end_step(s);
}

/// Modified update stress last (Sulsky, Zhou & Schreyer, Comput. Phys. Commun. 87 (1995) 236;
/// docs/theory/mpm.md, 5).
void step_musl(Stages& s, double until) {
  begin_step(s, until);  // (6.1)
  bin_particles(s);
  conduct_heat(s);
  s.transfers.to_grid(send_sums(s));  // (3.1)-(3.3)
  find_surfaces(s);
  s.transfers.advance_grid(contact(s));  // (3.4), (5.9)
  s.transfers.apply_full_mass_matrix();
  move_particles(s);  // (5.1)-(5.2) v, x at n+1; the grid sees the places of before
  s.transfers.momentum_to_grid(send_momentum(s));  // (5.3) grid velocity from the new v
  s.material.update("velocity gradient", Energy::by_constitutive_model, [&](const Take& take) {
    s.transfers.gradient_to_particles(take,
                                      receive(s));  // (5.4) grad v at the old places, by it stress and e
  });
  end_step(s);
}

}  // namespace

void bin_particles(Stages& s) {
  s.state.profile.time("bin particles", [&] {
    s.activity.shift_grid();
    s.partition.bin_particles();
    s.activity.find();
    s.contact.separate_fields();
    s.transfers.evaluate_loads();
  });
  s.fill.look();
}

void advance(Stages& s, double until) {
  switch (s.state.setup.time.scheme) {
    case cases::Scheme::symplectic:
      return step_symplectic(s, until);
    case cases::Scheme::musl:
      return step_musl(s, until);
    case cases::Scheme::usl:
      return step_usl(s, until);
    case cases::Scheme::usf:
      return step_usf(s, until);
  }
}

}  // namespace whipple::solver
