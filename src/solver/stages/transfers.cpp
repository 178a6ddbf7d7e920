// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/transfers.hpp"

#include <algorithm>
#include <cmath>

#include "src/transfer/particles_to_grid.hpp"

namespace whipple::solver {
namespace {

transfer::AffineField affine_field(const cases::TransferControl& control) {
  using enum transfer::AffineField;
  if (!cases::is_affine(control.particle_update)) return none;
  return control.affine_field == cases::AffineTransport::turned ? turned : deformed;
}

/// Returns beta of every particle update; FMPM is PIC with a different grid velocity.
transfer::Relaxation relaxation(const cases::TransferControl& control) {
  using enum cases::ParticleUpdate;
  switch (control.particle_update) {
    case apic:
    case pic:
    case fmpm:
      return {.kappa = 0.0, .fixed = 1.0};
    case flip:
      return {.kappa = 0.0, .fixed = 0.0};
    case blend:
      return {.kappa = 0.0, .fixed = 1.0 - control.flip_fraction};
    case relaxed_affine:
    case by_scheme:
      break;
  }
  return {.kappa = control.kappa, .fixed = -1.0};
}

}  // namespace

/// Returns which bodies are averaged over cells.
static transfer::AveragedBodies averaged_bodies(const cases::Case& setup) {
  std::vector<std::uint8_t> is_averaged;
  for (const cases::Body& body : setup.bodies) {
    is_averaged.push_back(body.volumetric == cases::Volumetric::cell ? 1 : 0);
  }
  return transfer::AveragedBodies(is_averaged);
}

Transfers::Transfers(State& state, const Loads& loads, const Activity& activity)
    : state_(state),
      loads_(loads),
      activity_(activity),
      drive_(state.setup),
      averaged_(averaged_bodies(state.setup)) {
  if (state_.force_gauges.any()) {
    grid_update_.watch_impulses(
        [this](std::uint32_t node, const Vector3& impulse) {
          state_.force_gauges.book_node(state_.grid, node, impulse);
        },
        state_.force_gauges.any_of_body());
  }
  const cases::Dissipation& control = state_.setup.dissipation;
  for (std::size_t b = 0; b < state_.setup.bodies.size(); ++b) {
    const cases::ArtificialViscosity& viscosity = state_.setup.viscosity_of(b);
    shock_conductivity_.push_back(
        {.heat_capacity = std::max(state_.setup.materials[b]->reference.heat_capacity, 0.0),
         .linear_viscosity = viscosity.linear,
         .quadratic_viscosity = viscosity.quadratic});
  }
  losses_ = {.become = control.keeps_losses() ? transfer::LossesBecome::unresolved_energy
                                              : transfer::LossesBecome::heat,
             .heat_share = control.heat_share,
             .allowance_length = control.allowance_time * state_.setup.domain.cell_size,
             .collision_rate = control.collision_rate,
             .initial_density = state_.initial_density};
}

/// Sets the accelerations of particles in inactive blocks to 0: nothing moves them in this step.
static void keep_at_rest(const grid::BlockGrid& grid, std::vector<Vector3>& acceleration) {
  std::vector<std::uint8_t> takes_part(acceleration.size(), 0);
  for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
    for (const std::uint32_t p : grid.particles_in(slot)) takes_part[p] = 1;
  }
  for (std::size_t p = 0; p < acceleration.size(); ++p) {
    if (takes_part[p] == 0) acceleration[p] = Vector3::Zero();
  }
}

void Transfers::evaluate_loads() {
  const Particles& particles = state_.particles;
  acceleration_.clear();
  if (loads_.act(state_.run.time)) {
    acceleration_.resize(particles.size(), Vector3::Zero());
    for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
      const std::size_t first = state_.bodies[b].first, count = state_.bodies[b].count;
      loads_.add_to(
          {std::span(particles.id).subspan(first, count), std::span(particles.position).subspan(first, count),
           std::span(particles.velocity).subspan(first, count), b},
          state_.run.time, std::span(acceleration_).subspan(first, count));
    }
    if (state_.run.particles_at_rest > 0) keep_at_rest(state_.grid, acceleration_);
  }
  drive_.add(state_, acceleration_);
  for (std::size_t p = 0; p < acceleration_.size(); ++p) {
    state_.booked.external_impulse += particles.mass[p] * state_.run.time_step * acceleration_[p];
  }
}

void Transfers::conduct_in_shocks() {
  const cases::Dissipation& control = state_.setup.dissipation;
  if (!control.keeps_losses() || !(control.shock_conduction > 0.0)) return;
  state_.profile.time("conduction", [&] {
    state_.booked.conducted_heat += transfer::conduct_in_shocks(
        state_.shape, state_.particles, state_.grid, state_.run.time_step,
        {control.shock_conduction, control.conduction_onset, control.conduction_rise, shock_conductivity_});
  });
}

void Transfers::conduct_heat(const transfer::TouchAtNode& touch) {
  state_.profile.time("conduction", [&] {
    std::vector<transfer::ThermalConstants> constants;
    for (const auto& material : state_.setup.materials) {
      const double capacity = material->reference.heat_capacity;
      constants.push_back({material->conductivity, capacity > 0.0 ? capacity : 1.0});
    }
    transfer::conduct_heat(state_.particles, state_.grid, state_.run.time_step, constants, touch);
  });
}

void Transfers::find_shared_cells() { shared_cells_.find(state_.particles, state_.grid, averaged_); }

void Transfers::average_stress() {
  if (!averaged_.any()) return;
  mean_stress_.resize(state_.particles.size());
  transfer::average_stress(state_.particles, state_.grid, averaged_, shared_cells_, mean_stress_);
}

void Transfers::sum_volume_rates(transfer::Sweep& sweep) {
  shared_cells_.clear();
  sweep.for_each_stretch(transfer::Region::border, [&](const transfer::Stretch& stretch) {
    transfer::sum_volume_rate(state_.particles, state_.grid, averaged_, shared_cells_, stretch);
  });
  shared_cells_.add_ranks(state_.grid);
}

void Transfers::average_volume_rate(const transfer::Stretch& stretch) {
  if (!averaged_.any()) return;
  transfer::average_volume_rate(state_.particles, state_.grid, averaged_, shared_cells_, stretch);
}

void Transfers::average_volume_rate_and_work(const transfer::Stretch& stretch) {
  if (!averaged_.any()) return;
  transfer::average_volume_rate_and_work(state_.particles, state_.grid, averaged_, shared_cells_, stretch,
                                         state_.run.time_step);
}

void Transfers::to_grid(transfer::Region region) {
  transfer::particles_to_grid(state_.functions(), state_.particles, state_.grid, region, acceleration_,
                              mean_stress_);
  if (state_.transition.size() > 0) {
    transfer::nodes_to_grid(state_.shape, state_.transition, state_.grid, region);
  }
}

void Transfers::account_for_hoops() {
  if (!state_.setup.geometry.is_axisymmetric()) return;
  state_.booked.wall_impulse[1] -=
      state_.run.time_step * transfer::hoop_force(state_.particles, state_.grid, mean_stress_);
}

void Transfers::clear_momentum() { transfer::clear_momentum(state_.grid); }

void Transfers::momentum_to_grid(transfer::Region region) {
  transfer::momentum_to_grid(state_.shape, state_.particles, state_.particles.velocity, state_.grid, region);
}

void Transfers::solve_momentum() {
  const double dt = state_.run.time_step;
  grid_update_.solve_momentum(state_.grid, dt, relaxation(state_.setup.transfer),
                              state_.setup.damping.mean(state_.run.time, dt));
}

void Transfers::share_step() { state_.booked.wall_impulse += grid_update_.share_step(state_.grid); }

void Transfers::apply_full_mass_matrix() {
  if (state_.setup.transfer.particle_update != cases::ParticleUpdate::fmpm) return;
  receive();
  state_.profile.time("full mass matrix", [&] {
    state_.booked.wall_impulse +=
        full_mass_matrix_.apply(state_.shape, state_.particles, state_.grid, grid_update_,
                                static_cast<int>(state_.setup.transfer.fmpm_order));
  });
}

void Transfers::receive() {
  state_.booked.wall_impulse += grid_update_.receive(state_.grid);
  state_.booked.contact_heat += grid_update_.take_contact_heat();
  const contact::GridUpdate::Damped damped = grid_update_.take_damping(state_.grid);
  state_.booked.external_impulse += damped.impulse;
  state_.booked.damping_work += damped.work;
}

void Transfers::to_particles(const transfer::Stretch& stretch) {
  transfer::grid_to_particles({.functions = state_.functions(),
                               .dt = state_.run.time_step,
                               .affine = affine_field(state_.setup.transfer),
                               .losses = losses_,
                               .acceleration = acceleration_},
                              state_.particles, state_.grid, stretch);
}

void Transfers::velocity_to_particles(const transfer::Stretch& stretch, transfer::Gradients gradients) {
  transfer::update_velocity({.functions = state_.functions(),
                             .dt = state_.run.time_step,
                             .relaxation = relaxation(state_.setup.transfer).fixed,
                             .gradients = gradients,
                             .acceleration = acceleration_},
                            state_.particles, state_.grid, stretch);
}

void Transfers::gradient_to_particles(const transfer::Stretch& stretch) {
  transfer::gather_velocity_gradient(state_.functions(), state_.particles, state_.grid, stretch);
}

void Transfers::account_for(const transfer::TransferBalance& balance) {
  Ledger& booked = state_.booked;
  booked.work += balance.work;
  booked.viscous_work += balance.viscous_work;
  booked.transfer_heat += balance.heat;
  booked.unresolved_kept += balance.kept;
  booked.unresolved_returned += balance.returned;
  booked.external_work += balance.external_work;
  state_.rates.squared_change = balance.squared_change;
}

void Transfers::to_nodes() {
  if (state_.transition.size() == 0) return;
  transfer::grid_to_nodes(state_.functions(), state_.transition, state_.grid, state_.run.time_step,
                          affine_field(state_.setup.transfer));
}

void Transfers::fly() {
  for (const std::uint32_t p : activity_.flying()) {
    state_.particles.position[p] += state_.run.time_step * state_.particles.velocity[p];
  }
  if (losses_.become == transfer::LossesBecome::heat) return;
  for (const std::uint32_t p : activity_.flying()) state_.particles.closing_rate[p] = 0.0;
}

}  // namespace whipple::solver
