// SPDX-License-Identifier: BSD-3-Clause
#include <ranges>
#include <string_view>

#include "src/solver/carriers/domains.hpp"
#include "src/solver/stages.hpp"
#include "src/solver/stages/levels.hpp"

/// The time steps, one function per scheme. Numbers are equations of docs/theory/mpm.md; superscripts give the time
/// level of a quantity after the call. Particles are processed by region (grid::BlockGrid::Region): those of a rank's
/// border first when they contribute to nodes, whose sums are sent while the interior is processed, and last when they
/// gather from nodes, so that nodes of other ranks can arrive in the meantime.
namespace whipple::solver {
namespace {

using Energy = MaterialStage::Energy;
using transfer::Gradients;
using transfer::Region;
using transfer::Stretch;
using transfer::Sweep;

/// Sets dt to the minimum of its bounds (6.1), then splits particles with too long domains where the case requests it
/// (2.5), and evaluates the loads of the case in this step (3.5b) to (3.5d).
void begin_step(Stages& s, double until) {
  s.time_step.begin(until);
  s.contact.watch_touches(s.time_step.accurate_step());
  domains::split(s.state, s.carriers, s.particles);
  s.applied_loads.begin();
}

/// Conducts heat where the case requests it: in shocks (docs/theory/dissipation.md), and between particles
/// (docs/theory/conduction.md).
void conduct_heat(Stages& s) {
  s.transfers.conduct_in_shocks();
  if (!s.state.setup.heat.conduction) return;
  s.contact.find_surfaces(false);
  s.transfers.conduct_heat(s.contact.touch_at_node());
}

/// Finds the surfaces for contact from the masses of the nodes.
void find_surfaces(Stages& s) {
  s.contact.find_surfaces(true);
  s.contact.find_surfaces_at_walls();
}

/// Computes m, (mv) and f of the nodes from particles and nodes of elements, (3.1) to (3.3).
void particles_to_grid(Stages& s) {
  s.state.profile.time("particles to grid", [&] {
    s.transfers.clear_grid();
    s.transfers.average_stress();
    for (const Region region : {Region::border, Region::interior}) {
      s.transfers.to_grid(region);
      if (region == Region::border) s.transfers.send_sums();
    }
  });
  s.transfers.account_for_hoops();
}

/// Computes v of the nodes from m and (mv) of particles, (5.3), (5.5).
void velocity_to_grid(Stages& s) {
  s.state.profile.time("momentum to grid", [&] {
    s.transfers.clear_momentum();
    for (const Region region : {Region::border, Region::interior}) {
      s.transfers.momentum_to_grid(region);
      if (region == Region::border) s.transfers.send_momentum();
    }
    s.transfers.solve_velocity();
  });
}

/// Advances the nodes, v^{n+1} = v^n + dt f^n / m, with contact of bodies, then mirror planes and walls, (3.4) to
/// (3.12).
void advance_grid(Stages& s) {
  s.state.profile.time("grid", [&] {
    s.transfers.solve_momentum();
    s.contact.apply();
    s.transfers.share_step();
  });
  s.transfers.apply_full_mass_matrix();
}

/// Updates v and x of particles, (5.1), (5.2); their material is strained later.
void move_particles(Stages& s) {
  s.state.profile.time("grid to particles", [&] {
    Sweep sweep(s.state.grid);
    for (const Region region : {Region::interior, Region::border}) {
      if (region == Region::border) s.transfers.receive();
      sweep.for_each_stretch(region, [&](const Stretch& stretch) {
        s.transfers.velocity_to_particles(stretch, Gradients::none);
      });
    }
    s.transfers.account_for(sweep.balance());
    s.transfers.fly();
  });
}

/// Calls gather(stretch), then strain(stretch), for all stretches of a sweep. Where volume rates are averaged over
/// particles of several ranks, (4.13), the border is gathered as a whole before its material is strained.
template <class Gather, class Strain>
void gather_and_strain(Stages& s, Sweep& sweep, Gather&& gather, Strain&& strain) {
  const auto both = [&](const Stretch& stretch) {
    gather(stretch);
    strain(stretch);
  };
  sweep.for_each_stretch(Region::interior, both);
  s.transfers.receive();
  if (!s.transfers.averages_over_ranks()) return sweep.for_each_stretch(Region::border, both);
  sweep.keep_border();
  sweep.for_each_stretch(Region::border, gather);
  s.transfers.sum_volume_rates(sweep);
  sweep.for_each_stretch(Region::border, strain);
}

/// Strains the material by the gradients of v on the nodes, (5.4), (5.6).
void strain_particles(Stages& s) {
  constexpr std::string_view stage = "velocity gradient";
  s.state.profile.time(stage, [&] {
    Sweep sweep = s.transfers.sweep();
    s.material.begin(Energy::by_constitutive_model, sweep.stretches());
    gather_and_strain(
        s, sweep,
        [&](const Stretch& stretch) {
          s.transfers.gradient_to_particles(stretch);  // grad v
        },
        [&](const Stretch& stretch) {
          s.transfers.average_volume_rate(stretch);  // (4.13)
          s.material.update(stretch);                // stress, p, T, phase, e from grad v
        });
    s.material.end(stage);
  });
}

/// Updates the ledger of energy and momentum and the rates that bound the next step.
void close_step(Stages& s) {
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

/// Removes what has left the domain and closes the step.
void end_step(Stages& s) {
  s.state.profile.time("boundaries", [&] {
    // Elements first: this fixes the order of the sum of the outflow.
    for (Carrier* carrier : s.carriers | std::views::drop(1)) carrier->remove_outside();
    s.particles.remove_outside();
    s.particles.retire_products();
  });
  close_step(s);
}

/// Performs a step of the symplectic scheme with exact energy (docs/theory/mpm.md, section 4).
void step_symplectic(Stages& s, double until) {
  s.elements.adapt(s.contact.has_fields());  // distorted elements become particles (docs/theory/afemp.md)
  begin_step(s, until);                      // (6.1) dt from c, |v|, |a|; (2.5)-(2.7)
  s.elements.compute_forces();               // f^n of elements on their nodes (docs/theory/fem.md)
  bin_particles(s);                          // blocks are adapted to the material
  conduct_heat(s);                           // changes e
  particles_to_grid(s);                      // (3.1)-(3.3) m, (mv)^n, f^n on nodes
  find_surfaces(s);
  advance_grid(s);  // (3.4)-(3.12) v^{n+1}
  constexpr std::string_view stage = "grid to particles";
  s.state.profile.time(stage, [&] {
    Sweep sweep = s.transfers.sweep();
    s.material.begin(Energy::by_work_identity, sweep.stretches());
    gather_and_strain(
        s, sweep,
        [&](const Stretch& stretch) {
          s.transfers.to_particles(stretch);  // (4.2)-(4.8) v, C, x, e at n+1, grad v^{n+1}
        },
        [&](const Stretch& stretch) {
          s.transfers.average_volume_rate_and_work(stretch);  // (4.13), (4.14)
          s.material.update(stretch);                         // stress, p, T, phase from it
        });
    s.transfers.account_for(sweep.balance());
    s.transfers.to_nodes();  // the same for nodes of elements
    s.transfers.fly();       // x of particles in free flight
    s.material.end(stage);
  });
  s.elements.advance();
  end_step(s);  // walls and outflow; energy and momentum
}

/// Performs the same step on a device.
void step_on_device(Stages& s, double until) {
  s.time_step.begin(until);
  s.contact.watch_touches(s.time_step.accurate_step());
  if (s.device->must_divide()) {  // rare: on the host
    s.device->synchronize();
    domains::split(s.state, s.carriers, s.particles);
    s.device->upload();
  }
  s.applied_loads.begin();
  const bool looks = s.fill.is_due();
  const double beside_voids =
      s.device->step(s.time_step.accurate_step(), s.loads.uniform_at(s.state.run.time), looks);
  if (looks) s.fill.judge(beside_voids);
  close_step(s);
}

/// Performs a step of the scheme "update stress first" (Bardenhagen, J. Comput. Phys. 180 (2002) 383;
/// docs/theory/mpm.md, section 5).
void step_usf(Stages& s, double until) {
  begin_step(s, until);  // (6.1)
  bin_particles(s);
  conduct_heat(s);
  s.contact.find_surfaces_at_walls();  // here: the grid has not been advanced in this step
  velocity_to_grid(s);                 // (5.5) v^n on nodes
  strain_particles(s);                 // (5.6) grad v^n, stress and e from it
  particles_to_grid(s);                // (3.1)-(3.3) with the new stress
  find_surfaces(s);
  advance_grid(s);    // (3.4), (5.9)
  move_particles(s);  // (5.1)-(5.2) v, x at n+1
  end_step(s);
}

/// Performs a step of the scheme "update stress last" (Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Eng. 118
/// (1994) 179; docs/theory/mpm.md, section 5).
void step_usl(Stages& s, double until) {
  begin_step(s, until);  // (6.1)
  bin_particles(s);
  conduct_heat(s);
  particles_to_grid(s);  // (3.1)-(3.3)
  find_surfaces(s);
  advance_grid(s);  // (3.4), (5.9)
  constexpr std::string_view stage = "grid to particles";
  s.state.profile.time(stage, [&] {
    Sweep sweep = s.transfers.sweep();
    s.material.begin(Energy::by_constitutive_model, sweep.stretches());
    gather_and_strain(
        s, sweep,
        [&](const Stretch& stretch) {
          s.transfers.velocity_to_particles(stretch, Gradients::of_grid_velocity);  // (5.1)-(5.2) v, x at n+1
        },
        [&](const Stretch& stretch) {
          s.transfers.average_volume_rate(stretch);  // (4.13)
          s.material.update(stretch);                // (5.7) stress, e from grad v^{n+1}
        });
    s.transfers.account_for(sweep.balance());
    s.transfers.fly();
    s.material.end(stage);
  });
  end_step(s);
}

/// Performs a step of the scheme "modified update stress last" (Sulsky, Zhou & Schreyer, Comput. Phys. Commun. 87
/// (1995) 236; docs/theory/mpm.md, section 5).
void step_musl(Stages& s, double until) {
  begin_step(s, until);  // (6.1)
  bin_particles(s);
  conduct_heat(s);
  particles_to_grid(s);  // (3.1)-(3.3)
  find_surfaces(s);
  advance_grid(s);      // (3.4), (5.9)
  move_particles(s);    // (5.1)-(5.2) v, x at n+1; the grid keeps the former positions
  velocity_to_grid(s);  // (5.3) grid velocity from the new v
  strain_particles(s);  // (5.4) grad v at the former positions, stress and e from it
  end_step(s);
}

/// Performs a load step without inertia (docs/theory/quasi_static.md).
void step_quasi_static(Stages& s, double until) {
  s.load_step.perform(until);
  end_step(s);
}

}  // namespace

void bin_particles(Stages& s) {
  s.state.profile.time("bin particles", [&] {
    s.activity.shift_grid();
    s.partition.bin_particles();
    s.activity.find();
    s.contact.separate_fields();
    if (s.state.grid.has_two_levels()) watch_levels(s.state);
    s.transfers.find_shared_cells();
    s.transfers.evaluate_loads();
  });
  s.fill.look();
}

void advance(Stages& s, double until) {
  if (s.device) return step_on_device(s, until);
  switch (s.state.setup.time.scheme) {
    case cases::Scheme::symplectic:
      return step_symplectic(s, until);
    case cases::Scheme::musl:
      return step_musl(s, until);
    case cases::Scheme::usl:
      return step_usl(s, until);
    case cases::Scheme::usf:
      return step_usf(s, until);
    case cases::Scheme::quasi_static:
      return step_quasi_static(s, until);
  }
}

}  // namespace whipple::solver
