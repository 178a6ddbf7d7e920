// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/load_step.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/solver/carriers/domains.hpp"
#include "src/solver/stages/material.hpp"

namespace whipple::solver {
namespace {

/// Fields of particles with a kept grid: where they began, and their deformation since then.
const HistoryField reference_position = {.name = "reference_position",
                                         .unit = "m",
                                         .meaning = "position at the start of a kept grid",
                                         .rank = Rank::vector};
const HistoryField grid_deformation = {.name = "grid_deformation",
                                       .unit = "1",
                                       .meaning = "deformation gradient since the start of a kept grid",
                                       .rank = Rank::tensor,
                                       .neutral = 1.0};

constexpr int quick = 5;        // iterations after which the next step may be longer
constexpr double growth = 1.5;  // of the step then

}  // namespace

/// Holds one attempt at a load step: the equations of a step of a given length, and what became of them.
struct LoadStep::Attempt {
  const quasi_static::Supports& supports;
  std::vector<std::optional<quasi_static::Given>> given;  // of the active nodes
  quasi_static::Unknowns unknowns;
  quasi_static::System system;
  quasi_static::Response response;
  std::vector<Vector3> before, after;                    // external accelerations of the particles, m/s^2
  std::vector<Vector3> external_before, external_after;  // forces of the nodes, N
  std::vector<Vector3> internal_before;
  quasi_static::Convergence result;

  Attempt(const quasi_static::Supports& nodes, const grid::BlockGrid& grid, const Particles& particles,
          std::span<const std::optional<Vector3>> of_bodies, std::vector<quasi_static::Group> groups,
          std::vector<double> border)
      : supports(nodes),
        given(quasi_static::given_displacements(nodes, particles, of_bodies)),
        unknowns(nodes, grid, given),
        system(nodes, unknowns, std::move(border)),
        response(particles, std::move(groups), nodes.strains()) {
    std::vector<double> forces(particles.size() * static_cast<std::size_t>(nodes.strains()));
    response.at_beginning(forces);
    internal_before = system.internal(forces, std::vector<Vector3>(nodes.nodes(), Vector3::Zero()));
  }
};

LoadStep::LoadStep(State& state, const Loads& loads, AppliedLoads& applied_loads, Partition& partition)
    : state_(state),
      loads_(loads),
      applied_loads_(applied_loads),
      partition_(partition),
      keeps_grid_(state.setup.quasi_static.grid == cases::LoadStepGrid::kept) {}

void LoadStep::begin_run() {
  if (cases::has_inertia(state_.setup.time.scheme)) return;
  if (state_.is_parallel()) {
    throw InputError(
        "time.scheme = \"quasi_static\" runs on one rank: start it without mpirun; threads are "
        "possible (--threads)");
  }
  Particles& particles = state_.particles;
  std::ranges::fill(particles.velocity, Vector3::Zero());
  if (!keeps_grid_) return;
  const bool resumes = particles.history.find(reference_position.name) != nullptr;
  particles.history.declare(reference_position, particles.size());
  particles.history.declare(grid_deformation, particles.size());
  if (!resumes) particles.history.values<Vector3>(reference_position.name) = particles.position;
}

/// Sets the length of the step: that of the last one if it was cut, or its growth, to the number of steps of the case.
void LoadStep::choose_length(double until) {
  RunState& run = state_.run;
  const double whole = state_.setup.time.end / static_cast<double>(state_.setup.quasi_static.steps);
  if (!(run.unclipped_step > 0.0)) run.unclipped_step = whole;
  run.unclipped_step = std::min(run.unclipped_step, whole);
  const double left = until - run.time;
  if (!(left > 0.0)) throw InternalError(fmt::format("t = {} s has been reached already", until));
  constexpr double round_off = 1e-9;
  state_.time_step_bound = run.unclipped_step < whole ? TimeStepBound::cut_back : TimeStepBound::load_step;
  run.time_step = run.unclipped_step;
  if (run.time_step > left * (1.0 - round_off)) {
    run.time_step = left;
    state_.time_step_bound = TimeStepBound::output_time;
  } else if (2.0 * run.time_step > left * (1.0 + round_off)) {
    run.time_step = 0.5 * left;
  }
}

/// Bins the particles at their positions, on a kept grid at those of its start.
void LoadStep::bin() {
  Particles& particles = state_.particles;
  if (!keeps_grid_) return partition_.bin_particles();
  particles.position.swap(particles.history.values<Vector3>(reference_position.name));
  partition_.bin_particles();
  particles.position.swap(particles.history.values<Vector3>(reference_position.name));
}

std::vector<Vector3> LoadStep::accelerations(double time) {
  applied_loads_.hold(time);
  std::vector<Vector3> all(state_.particles.size(), Vector3::Zero());
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    const std::size_t first = state_.bodies[b].first, count = state_.bodies[b].count;
    const Particles& particles = state_.particles;
    loads_.add_to(
        {std::span(particles.id).subspan(first, count), std::span(particles.position).subspan(first, count),
         std::span(particles.velocity).subspan(first, count), b},
        time, std::span(all).subspan(first, count));
  }
  return all;
}

quasi_static::Supports LoadStep::find_supports() {
  Particles& particles = state_.particles;
  const bool with_border = state_.setup.quasi_static.border_stiffness > 0.0;
  if (!keeps_grid_) {
    return quasi_static::find_supports(state_.functions(), particles, state_.grid, with_border);
  }
  std::vector<Vector3>& reference = particles.history.values<Vector3>(reference_position.name);
  particles.position.swap(reference);
  quasi_static::Supports supports =
      quasi_static::find_supports(state_.functions(), particles, state_.grid, with_border);
  particles.position.swap(reference);
  // Slopes of functions that move with the material: F^-T grad_0 N (eq. 7).
  const auto& deformation = particles.history.values<Matrix3>(grid_deformation.name);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Matrix3 turned = deformation[p].inverse().transpose();
    for (std::size_t k = supports.particles.begin[p]; k < supports.particles.begin[p + 1]; ++k) {
      Vector3& gradient = supports.particles.reached[k].gradient;
      gradient = turned * gradient;
    }
    if (!supports.per_radius.empty()) supports.per_radius[p] = 1.0 / particles.position[p][1];
  }
  return supports;
}

std::vector<quasi_static::Group> LoadStep::groups() const {
  std::vector<quasi_static::Group> groups;
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    UpdateSettings settings = update_settings(state_, b);
    settings.linear_viscosity = settings.quadratic_viscosity = settings.expansion_viscosity = 0.0;
    groups.push_back({.material = state_.setup.materials[b].get(),
                      .first = state_.bodies[b].first,
                      .count = state_.bodies[b].count,
                      .settings = settings});
  }
  return groups;
}

/// Returns the displacement of each driven body in the step, m.
std::vector<std::optional<Vector3>> LoadStep::displacements_of_bodies() const {
  std::vector<std::optional<Vector3>> all;
  for (const cases::Body& body : state_.setup.bodies) {
    all.emplace_back();
    if (!body.driven) continue;
    const double dt = state_.run.time_step;
    const double factor = body.path ? body.path->factor(state_.run.time, dt) : 1.0;
    all.back() = factor * dt * body.velocity;
  }
  return all;
}

/// Returns the stiffness of the points at the border, times their volume: a part of rho c^2 of their material, J.
std::vector<double> LoadStep::border_moduli(const quasi_static::Supports& supports) const {
  const Particles& particles = state_.particles;
  std::vector<double> moduli;
  for (std::size_t q = 0; q < supports.border.size(); ++q) {
    const std::uint32_t p = supports.border_particle[q];
    const double density = particles.mass[p] / particles.volume[p];
    moduli.push_back(state_.setup.quasi_static.border_stiffness * density * particles.sound_speed[p] *
                     particles.sound_speed[p] * supports.border_volume[q]);
  }
  return moduli;
}

void LoadStep::perform(double until) {
  const cases::QuasiStatic& control = state_.setup.quasi_static;
  RunState& run = state_.run;
  const quasi_static::NewtonControl newton = {.tolerance = control.tolerance,
                                              .iterations = static_cast<int>(control.iterations)};
  if (state_.particle_count == 0) throw StateError("all material has left the domain");
  choose_length(until);
  state_.profile.time("bin particles", [&] { bin(); });
  const quasi_static::Supports supports = find_supports();
  const std::vector<Vector3> before = accelerations(run.time);
  const double least = control.least_step * state_.setup.time.end;
  for (;;) {
    Attempt attempt(supports, state_.grid, state_.particles, displacements_of_bodies(), groups(),
                    border_moduli(supports));
    attempt.before = before;
    attempt.after = accelerations(run.time + run.time_step);
    attempt.external_before = attempt.system.external(state_.particles, attempt.before);
    attempt.external_after = attempt.system.external(state_.particles, attempt.after);
    state_.profile.time("load step", [&] {
      attempt.result = find_equilibrium(attempt.system, attempt.unknowns, attempt.response, supports,
                                        attempt.external_after, newton);
    });
    state_.profile.reassign("load step", "tangents of the material", attempt.result.tangent_seconds);
    state_.profile.reassign("load step", "linear equations", attempt.result.linear_seconds);
    state_.equilibrium.iterations += attempt.result.iterations;
    if (attempt.result.reached) {
      commit(attempt);
      if (state_.time_step_bound != TimeStepBound::output_time && attempt.result.iterations <= quick) {
        run.unclipped_step *= growth;
      }
      return;
    }
    if (0.5 * run.time_step < least) give_up(attempt);
    run.time_step *= 0.5;
    run.unclipped_step = run.time_step;
    state_.time_step_bound = TimeStepBound::cut_back;
  }
}

void LoadStep::commit(const Attempt& attempt) {
  state_.equilibrium.residuals = attempt.result.residuals;
  static_cast<MaterialPoints&>(state_.particles) = attempt.response.trial();
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    const std::string error =
        solver::book(state_, attempt.response.reports()[b], *state_.setup.materials[b],
                     [&](std::size_t p, const std::string& reason) {
                       return state_.describe_particle(p, state_.run.time + state_.run.time_step, reason);
                     });
    if (!error.empty()) throw StateError(error);
  }
  book(attempt);
  move(attempt);
}

/// Moves the particles with the nodes, and what their domains and the kept grid remember.
void LoadStep::move(const Attempt& attempt) {
  Particles& particles = state_.particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    for (const quasi_static::Reached& reached : attempt.supports.particles.of(p)) {
      particles.position[p] += reached.n * attempt.result.u[reached.node];
    }
  }
  if (keeps_grid_) {
    auto& deformation = particles.history.values<Matrix3>(grid_deformation.name);
    for (std::size_t p = 0; p < particles.size(); ++p) deformation[p] = attempt.result.f[p] * deformation[p];
  }
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    if (!domains::follow_deformation(state_, b)) continue;
    std::vector<std::uint32_t> list;
    std::vector<Matrix3> gradients;
    for (std::size_t p = state_.bodies[b].first; p < state_.bodies[b].first + state_.bodies[b].count; ++p) {
      list.push_back(static_cast<std::uint32_t>(p));
      gradients.emplace_back((attempt.result.f[p] - Matrix3::Identity()) / state_.run.time_step);
    }
    state_.booked.limited_domains += static_cast<double>(domains::deform(state_, list, gradients));
  }
}

/// Books impulses and work of the step: those of the loads with the mean of the forces before and after, and those of
/// planes and driven bodies from what is left of the balance of their nodes (eq. 8).
void LoadStep::book(const Attempt& attempt) {
  const double dt = state_.run.time_step;
  const Particles& particles = state_.particles;
  Ledger& booked = state_.booked;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    booked.external_impulse += particles.mass[p] * dt * attempt.after[p];
  }
  double scale = 0.0;  // of the impulses
  for (std::size_t node = 0; node < attempt.supports.nodes(); ++node) {
    const Vector3& u = attempt.result.u[node];
    const Vector3 loads = 0.5 * (attempt.external_before[node] + attempt.external_after[node]);
    booked.external_work += loads.dot(u);
    const Vector3 reaction = attempt.result.internal[node] - attempt.external_after[node];
    const Vector3 at_beginning = attempt.internal_before[node] - attempt.external_before[node];
    for (int a = 0; a < 3; ++a) {
      if (attempt.unknowns.of(node, a).unknown < 0)
        booked.external_work += 0.5 * (reaction[a] + at_beginning[a]) * u[a];
    }
    Vector3 impulse = dt * reaction;
    // All around a ring only the component along the axis adds up: hoop stresses balance the other.
    if (state_.setup.geometry.is_axisymmetric()) impulse[1] = 0.0;
    booked.wall_impulse += impulse;
    scale += dt * reaction.norm();
    if (!state_.force_gauges.any()) continue;
    if (const auto& given = attempt.given[node]) {
      const auto& place = attempt.supports.places[node];
      const Vector3 position = state_.setup.geometry.lower +
                               state_.setup.geometry.cell_size * Vector3(place[0], place[1], place[2]);
      state_.force_gauges.book_held(given->body, position, -dt * reaction);
    } else {
      state_.force_gauges.book_node(state_.grid, attempt.supports.grid_node[node], dt * reaction);
    }
  }
  state_.run.ledger.largest_momentum = std::max(state_.run.ledger.largest_momentum, scale);
}

void LoadStep::give_up(const Attempt& attempt) const {
  const std::size_t node = attempt.result.worst_node;
  std::size_t nearest = 0;
  double most = -1.0;
  for (std::size_t p = 0; p < state_.particles.size(); ++p) {
    for (const quasi_static::Reached& reached : attempt.supports.particles.of(p)) {
      if (reached.node != node || reached.n <= most) continue;
      most = reached.n;
      nearest = p;
    }
  }
  std::vector<std::string> residuals;
  for (const double residual : attempt.result.residuals) residuals.push_back(fmt::format("{:.2e}", residual));
  throw StateError(state_.describe_particle(
      nearest, state_.run.time,
      fmt::format("load step {} does not converge even with a length of {:.3g} s: the material may carry no "
                  "more (limit load), or quasi_static.iterations are too few; relative residuals: {}; the "
                  "largest is at the node nearest to this particle",
                  state_.run.step + 1, state_.run.time_step, fmt::join(residuals, ", "))));
}

}  // namespace whipple::solver
