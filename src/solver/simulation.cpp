// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "src/afemp/transition.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/update.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/conduction.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/particles_to_grid.hpp"
#include "src/transfer/shock_conduction.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t sort_every = 20;  // steps between sorts of the particle arrays
/// Has the blocks distributed over the ranks anew once the material at rest is less than this part of what it was then.
constexpr double rest_of_old_shares = 0.8;
/// Keeps accuracy of a few particles of thin material from reducing the time step below this part of the stable one.
constexpr double least_share_for_accuracy = 0.125;

transfer::AffineField affine_field(const cases::TransferControl& control) {
  using enum transfer::AffineField;
  if (!cases::is_affine(control.particle_update)) return none;
  return control.affine_field == cases::AffineTransport::turned ? turned : deformed;
}

/// beta of every particle update; FMPM is PIC with another grid velocity.
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

transfer::ShapeFunction shape_of(const cases::Case& setup) {
  const transfer::ShapeFunction kind = setup.transfer.shape_function;
  return setup.domain.is_planar() ? transfer::in_plane(kind) : kind;
}

}  // namespace

Simulation::Simulation(const cases::Case& setup, MPI_Comm communicator)
    : setup_(setup),
      shape_(shape_of(setup)),
      communicator_(communicator),
      grid_(setup.geometry, communicator) {
  if (parallel::rank(communicator) == 0) {
    for (const std::string& text : cases::placement_warnings(setup)) log::warning("{}", text);
    for (const std::string& text : setup.contact_fields.warnings) log::warning("{}", text);
    for (const std::string& text : setup.contact_fields.remarks) log::info("{}", text);
  }
  cases::Seeding seeding = cases::seed(setup, parallel::rank(communicator), parallel::size(communicator));
  particles_ = std::move(seeding.particles);
  bodies_ = std::move(seeding.bodies);
  meshes_ = std::move(seeding.meshes);
  bars_ = std::move(seeding.bars);
  for (fem::Mesh& mesh : meshes_) afemp::mark_surface(mesh, setup_.geometry);
  keep_own_elements();
  set_up_contact();
  set_up_walls();
  if (!carries_affine_velocity()) {
    std::vector<Matrix3>().swap(particles_.affine_velocity);
  } else if (affine_field(setup_.transfer) == transfer::AffineField::none) {
    std::ranges::fill(particles_.affine_velocity, Matrix3::Zero().eval());
  }
  if (!carries_extent()) std::vector<SymmetricTensor>().swap(particles_.extent);
  prepare();
  state_.ledger.initial = totals_;
  // Planes have stopped the nodes on them: their momentum was there before.
  state_.ledger.initial.momentum -= seeding.wall_impulse;
  state_.ledger.wall_impulse += seeding.wall_impulse;
}

Simulation::Simulation(const cases::Case& setup, Particles particles, const RunState& state,
                       MPI_Comm communicator, std::vector<fem::Mesh> meshes, std::vector<fem::Bars> bars)
    : setup_(setup),
      shape_(shape_of(setup)),
      communicator_(communicator),
      particles_(std::move(particles)),
      meshes_(std::move(meshes)),
      bars_(std::move(bars)),
      bodies_(setup.bodies.size()),
      grid_(setup.geometry, communicator),
      state_(state) {
  gather_elements();
  set_up_contact();
  set_up_walls();
  require_fields();
  sort_by_body(particles_);  // checkpoints hold the particles of several ranks one after the other
  find_bodies();
  prepare();
}

/// Particles are sorted by body: the ranges follow from where the bodies change.
void Simulation::find_bodies() {
  for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
    const auto own = std::ranges::equal_range(particles_.body, b);
    bodies_[b].count = own.size();
    bodies_[b].first = own.empty() ? 0 : static_cast<std::size_t>(own.begin() - particles_.body.begin());
  }
}

/// Completes both constructors.
void Simulation::prepare() {
  step_outflow_.resize(bodies_.size());
  state_.outflow_of_body.resize(bodies_.size());
  first_touches_->set(state_.touched);
  set_up_bars();
  set_up_dissipation();
  if (const cases::Gravity g = setup_.gravity; !g.acceleration.isZero(0.0)) {
    add_acceleration([g](const Particles&, std::size_t, double time) { return g.at(time); });
  }
  sum_over_ranks();
}

/// Totals of all ranks, and what the step did to them.
void Simulation::sum_over_ranks() {
  totals_ = totals_of(particles_, particle_affine_inertia(), totals_of_chunk_.values,
                      stays_since(totals_of_chunk_.arrangement));
  for (const fem::Mesh& mesh : meshes_) totals_ += totals_of(mesh, affine_inertia());
  for (const fem::Bars& bars : bars_) totals_ += totals_of(bars, affine_inertia());
  std::vector<double> counts = {static_cast<double>(particles_.size()), 0.0};
  for (const fem::Mesh& mesh : meshes_) counts[1] += static_cast<double>(mesh.elements.size());
  for (const BodyOutflow& out : step_outflow_) {
    counts.insert(counts.end(), {out.mass, out.momentum[0], out.momentum[1], out.momentum[2], out.energy});
  }
  solver::sum_over_ranks(communicator_, totals_, step_);
  parallel::sum(communicator_, counts);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    BodyOutflow& out = state_.outflow_of_body[b];
    const double* const number = &counts[2 + 5 * b];
    out.mass += number[0];
    out.momentum += Vector3(number[1], number[2], number[3]);
    out.energy += number[4];
  }
  std::ranges::fill(step_outflow_, BodyOutflow{});
  particle_count_ = static_cast<std::size_t>(counts[0]);
  element_count_ = static_cast<std::size_t>(counts[1]);
  state_.ledger.add(step_);
  step_ = {};
}

double Simulation::affine_inertia() const {
  return transfer::affine_inertia(shape_, setup_.domain.cell_size);
}

/// Shape functions that can carry affine fields always do, perhaps as zeros.
bool Simulation::carries_affine_velocity() const { return affine_inertia() > 0.0; }

/// Returns the inertia per mass (m^2) of the affine fields that particles of this case carry; 0 without such fields.
double Simulation::particle_affine_inertia() const {
  return affine_field(setup_.transfer) == transfer::AffineField::none ? 0.0 : affine_inertia();
}

void Simulation::advance(double until) {
  switch (setup_.time.scheme) {
    case cases::Scheme::symplectic:
      return step_symplectic(*this, until);
    case cases::Scheme::musl:
      return step_musl(*this, until);
    case cases::Scheme::usl:
      return step_usl(*this, until);
    case cases::Scheme::usf:
      return step_usf(*this, until);
  }
}

/// For what moves with the grid; infinite if nothing does.
double Simulation::grid_time_step() {
  const auto speed_of = [](const auto& points, std::size_t p) {
    return points.sound_speed[p] + points.velocity[p].cwiseAbs().maxCoeff();
  };
  parallel::update_chunks(particles_.size(), fastest_of_chunk_.values,
                          stays_since(fastest_of_chunk_.arrangement),
                          [&](std::size_t begin, std::size_t end) {
                            double fastest = 0.0;
                            for (std::size_t p = begin; p < end; ++p) {
                              fastest = std::max(fastest, speed_of(particles_, p));
                            }
                            return fastest;
                          });
  double speed =
      parallel::maximum(transition_.size(), 0.0, [&](std::size_t p) { return speed_of(transition_, p); });
  for (const double fastest : fastest_of_chunk_.values) speed = std::max(speed, fastest);
  speed = parallel::maximum(communicator_, speed);
  return setup_.time.courant * setup_.domain.cell_size / speed;
}

/// For values by chunk of particles that are kept from step to step: those of material at rest stay.
/// @param arrangement  of the particles when the values were found; set to that of now
std::function<bool(std::size_t)> Simulation::stays_since(std::size_t& arrangement) const {
  const bool same = std::exchange(arrangement, grid_.arrangement()) == grid_.arrangement();
  return [this, same](std::size_t chunk) { return same && grid_.chunk_rests(chunk); };
}

/// That the state allows, whatever the step before it was.
double Simulation::accurate_time_step() {
  const double dx = setup_.domain.cell_size;
  compression_is_followed_ = true;
  double dt = std::min({grid_time_step(), diffusive_time_step(), element_time_step()});
  if (state_.maximum_acceleration > 0.0) {
    dt = std::min(dt, std::sqrt(setup_.time.acceleration_limit * dx / state_.maximum_acceleration));
  }
  if (state_.compression_rate > 0.0) {
    const double accurate = setup_.time.compression_limit / state_.compression_rate;
    compression_is_followed_ = accurate >= least_share_for_accuracy * dt;
    dt = std::min(dt, std::max(accurate, least_share_for_accuracy * dt));
  }
  return dt;
}

/// Explicit diffusion of momentum and of heat is stable below dx^2 / (9 a), a the diffusivity, whatever the
/// particles: the squares of the gradients of quadratic B-splines over their values add up to 18/dx^2 at most
/// (docs/theory/conduction.md, eq. 5).
double Simulation::diffusive_time_step() const {
  const double dx = setup_.domain.cell_size;
  double diffusivity = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Material& material = *setup_.materials[b];
    double per_volume = material.strength->viscosity();
    if (setup_.heat.conduction && material.conductivity > 0.0) {
      per_volume = std::max(per_volume, material.conductivity / material.reference.heat_capacity);
    }
    if (!(per_volume > 0.0)) continue;
    diffusivity = std::max(diffusivity, parallel::maximum(bodies_[b].count, 0.0, [&](std::size_t i) {
                             const std::size_t p = bodies_[b].first + i;
                             return per_volume * particles_.volume[p] / particles_.mass[p];
                           }));
  }
  diffusivity = parallel::maximum(communicator_, diffusivity);
  return diffusivity > 0.0 ? dx * dx / (18.0 * diffusivity) : std::numeric_limits<double>::infinity();
}

void Simulation::begin_step(double until) {
  profile_.time("time step", [&] {
    if (particle_count_ == 0 && element_count_ == 0) throw StateError("all matter has left the domain");
    double dt = stable_time_step();
    if (!(dt > 0.0) || !std::isfinite(dt)) {
      const std::string reason = fmt::format("the stable time step is {} s", dt);
      for (std::size_t p = 0; p < particles_.size(); ++p) {
        if (std::isfinite(particles_.sound_speed[p] + particles_.velocity[p].sum())) continue;
        throw StateError(describe_state(
            p, state_.time, fmt::format("{}; speed of sound {} m/s", reason, particles_.sound_speed[p])));
      }
      throw StateError(fmt::format("step {}, t = {} s: {}", state_.step, state_.time, reason));
    }
    if (!compression_is_followed_ && parallel::rank(communicator_) == 0) step_.held_time_steps += 1.0;
    state_.unclipped_step = dt;
    const double left = until - state_.time;
    if (!(left > 0.0)) throw InternalError(fmt::format("t = {} s has been reached already", until));
    // The last step before `until` lands on it; the one before is halved rather than leaving a sliver.
    if (dt >= left) {
      dt = left;
    } else if (2.0 * dt > left) {
      dt = 0.5 * left;
    }
    state_.time_step = dt;
    watch_touches();
  });
}

void Simulation::bin_particles() {
  profile_.time("bin particles", [&] {
    if (setup_.transfer.random_shift) shift_grid();
    const grid::Stencil stencil = transfer::stencil(shape_);
    const bool shares_are_old =
        parallel::size(communicator_) > 1 && static_cast<double>(state_.particles_at_rest) <
                                                 rest_of_old_shares * static_cast<double>(most_at_rest_);
    if (!bin(stencil) || shares_are_old) follow_particles(stencil);
    if (state_.step % sort_every == 0) {
      grid_.wake();
      sort_particles();
      if (!bin(stencil)) follow_particles(stencil);
    }
    if (setup_.transfer.free_flight) find_free_flight();
    let_matter_rest();
    separate_fields();
    external_acceleration_.clear();
    if (accelerations_.empty()) return;
    external_acceleration_.assign(particles_.size(), Vector3::Zero());
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      for (const auto& load : accelerations_) external_acceleration_[p] += load(particles_, p, state_.time);
      step_.external_impulse += particles_.mass[p] * state_.time_step * external_acceleration_[p];
    }
  });
  look_at_fill();
}

/// Particles, and nodes of elements as guests.
bool Simulation::bin(grid::Stencil stencil) {
  return grid_.bin(particles_.position, stencil, transition_.position);
}

/// By body (so that a material is a range), then by block, then by stencil.
void Simulation::sort_particles() {
  std::vector<std::uint32_t> next;
  for (const cases::BodySummary& body : bodies_) next.push_back(static_cast<std::uint32_t>(body.first));
  grid_.list_by_stencil(by_stencil_);
  sorted_.resize(particles_.size());
  for (const std::uint32_t p : by_stencil_) sorted_[next[particles_.body[p]]++] = p;
  reorder(particles_, sorted_, sort_buffers_);
  grid_.particles_reordered(sorted_);
}

/// After particles came, went or changed their places.
void Simulation::particles_reallocated() {
  sort_by_body(particles_);
  find_bodies();
  grid_.particles_reordered();
}

void Simulation::conduct_heat() {
  conduct_in_shocks();
  if (!setup_.heat.conduction) return;
  find_surfaces(false);
  profile_.time("conduction", [&] {
    std::vector<transfer::ThermalConstants> constants;
    for (const auto& material : setup_.materials) {
      const double capacity = material->reference.heat_capacity;
      constants.push_back({material->conductivity, capacity > 0.0 ? capacity : 1.0});
    }
    transfer::conduct_heat(particles_, grid_, state_.time_step, constants, touch_at_node());
  });
}

void Simulation::map_particles_to_grid() {
  profile_.time("particles to grid", [&] {
    const auto send = [&] { grid_update_.send(grid_, grid::BlockGrid::Part::both); };
    const bool with_nodes = transition_.size() > 0;
    transfer::particles_to_grid(shape_, particles_, grid_, external_acceleration_,
                                with_nodes ? std::function<void()>() : send);
    if (with_nodes) {
      transfer::nodes_to_grid(shape_, transition_, grid_);
      send();
    }
  });
  if (setup_.geometry.is_axisymmetric()) {
    step_.wall_impulse[1] -= state_.time_step * transfer::hoop_force(particles_, grid_);
  }
  find_surfaces(true);
  find_surfaces_at_walls();
}

void Simulation::advance_grid() {
  profile_.time("grid", [&] {
    const transfer::GridBalance balance = grid_update_.begin_advance(
        grid_, state_.time_step, relaxation(setup_.transfer), [&] { apply_contact(); });
    step_.wall_impulse += balance.wall_impulse;
  });
  if (setup_.transfer.particle_update != cases::ParticleUpdate::fmpm) return;
  finish_exchange();
  profile_.time("full mass matrix", [&] {
    step_.wall_impulse += full_mass_matrix_.apply(shape_, particles_, grid_, grid_update_,
                                                  static_cast<int>(setup_.transfer.fmpm_order));
  });
}

/// Receives the values of nodes that other ranks own, at the latest when the particles of the border need them.
void Simulation::finish_exchange() {
  step_.wall_impulse += grid_update_.finish(grid_);
  step_.contact_heat += grid_update_.take_contact_heat();
}

void Simulation::map_grid_to_particles() {
  const auto gather = [&](const transfer::TakeGradients& take) {
    const transfer::TransferBalance balance = transfer::grid_to_particles(
        shape_, particles_, grid_, state_.time_step, affine_field(setup_.transfer), losses_, take,
        external_acceleration_, [&] { finish_exchange(); });
    step_.work += balance.work;
    step_.viscous_work += balance.viscous_work;
    step_.plastic_work += balance.plastic_work;
    step_.transfer_heat += balance.heat;
    step_.unresolved_kept += balance.kept;
    step_.unresolved_returned += balance.returned;
    step_.external_work += balance.external_work;
    squared_change_ = balance.squared_change;
    if (transition_.size() > 0) {
      transfer::grid_to_nodes(shape_, transition_, grid_, state_.time_step, affine_field(setup_.transfer));
    }
    for (const std::uint32_t p : flying_) {
      particles_.position[p] += state_.time_step * particles_.velocity[p];
      if (losses_.kept) particles_.closing_rate[p] = 0.0;
    }
  };
  update_material_with("grid to particles", EnergyUpdate::by_work_identity, gather);
}

void Simulation::gather_velocity(const transfer::TakeGradients& take) {
  const transfer::TransferBalance balance = transfer::update_velocity(
      shape_, particles_, grid_, state_.time_step, relaxation(setup_.transfer).fixed, take,
      external_acceleration_, [&] { finish_exchange(); });
  step_.external_work += balance.external_work;
  step_.plastic_work += balance.plastic_work;
  squared_change_ = balance.squared_change;
  for (const std::uint32_t p : flying_) particles_.position[p] += state_.time_step * particles_.velocity[p];
}

void Simulation::update_particle_velocity() {
  profile_.time("grid to particles", [&] { gather_velocity({}); });
}

void Simulation::update_velocity_and_material() {
  update_material_with("grid to particles", EnergyUpdate::by_constitutive_model,
                       [&](const transfer::TakeGradients& take) { gather_velocity(take); });
}

void Simulation::map_momentum_to_grid() {
  // Of this scheme the grid has not been advanced in this step.
  if (setup_.time.scheme == cases::Scheme::usf) find_surfaces_at_walls();
  profile_.time("momentum to grid", [&] {
    transfer::momentum_to_grid(shape_, particles_, particles_.velocity, grid_,
                               [&] { grid_update_.send(grid_, grid::BlockGrid::Part::first); });
    grid_update_.begin_velocity_from_momentum(grid_);
  });
}

void Simulation::update_material() {
  update_material_with(
      "velocity gradient", EnergyUpdate::by_constitutive_model, [&](const transfer::TakeGradients& take) {
        step_.plastic_work +=
            transfer::gather_velocity_gradient(shape_, particles_, grid_, take, [&] { finish_exchange(); });
      });
}

void Simulation::end_step() {
  profile_.time("ledger", [&] {
    std::array<double, 3> fastest = {std::sqrt(squared_change_) / state_.time_step,
                                     std::exchange(compression_rate_, 0.0),
                                     std::exchange(element_compression_rate_, 0.0)};
    parallel::maximum(communicator_, fastest);
    state_.maximum_acceleration = fastest[0];
    state_.compression_rate = std::max(compression_rate_of_most(fastest[1]), fastest[2]);
    sum_over_ranks();
    state_.ledger.observe(totals_);
    ++state_.step;
    state_.time += state_.time_step;
    foresee_touches();
    const double error = state_.ledger.energy_error(totals_);
    // The negation also catches NaN.
    const double limit = setup_.output.energy_error_limit(setup_.time.scheme);
    if (!(std::abs(error) <= limit)) {
      throw StateError(
          fmt::format("step {}, t = {} s: the relative error of the total energy is {:.3e}, beyond "
                      "output.maximum_energy_error = {}",
                      state_.step, state_.time, error, limit));
    }
  });
}

std::string Simulation::describe_state(std::size_t p, double time, const std::string& reason) const {
  const Vector3& x = particles_.position[p];
  const Vector3& v = particles_.velocity[p];
  return fmt::format(
      "step {}, t = {} s, body \"{}\", particle {}: {}\n  position ({}, {}, {}) m, velocity ({}, "
      "{}, {}) m/s\n  density "
      "{} kg/m^3, specific internal energy {} J/kg, pressure {} Pa, temperature {} K, failed {}",
      state_.step + 1, time, setup_.bodies[particles_.body[p]].name, particles_.id[p], reason, x[0], x[1],
      x[2], v[0], v[1], v[2], particles_.mass[p] / particles_.volume[p],
      particles_.specific_internal_energy[p], particles_.pressure[p], particles_.temperature[p],
      particles_.failed[p]);
}

std::size_t Simulation::bytes() const {
  std::size_t bytes = grid_.bytes();
  const auto add = [&]<class Points>(const Points& points) {
    for_each_field<Points>([&](const auto& field) {
      const auto& values = points.*(field.values);
      bytes += values.size() * sizeof(values[0]);
    });
  };
  add(particles_);
  for (const fem::Mesh& mesh : meshes_) {
    add(mesh.nodes);
    add(mesh.elements);
    add(mesh.points);
  }
  for (const fem::Bars& bars : bars_) {
    add(bars.nodes);
    add(bars.elements);
  }
  return bytes;
}

}  // namespace whipple::solver
