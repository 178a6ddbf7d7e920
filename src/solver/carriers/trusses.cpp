// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/carriers/trusses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/afemp/transition.hpp"
#include "src/case/build/bars.hpp"
#include "src/particles/phases.hpp"
#include "src/particles/rows.hpp"
#include "src/solver/carriers/element_totals.hpp"
#include "src/solver/carriers/figures.hpp"
#include "src/solver/carriers/nodal_loads.hpp"
#include "src/solver/carriers/share_out.hpp"

namespace whipple::solver {

/// Completes the data that are not in files.
void Trusses::connect() {
  for (fem::Bars& bars : bars_) {
    bars.material = cases::bar_material(*state_.setup.materials[bars.body], state_.setup.bodies[bars.body]);
    fem::connect(bars);
  }
}

void Trusses::compute_forces() {
  acceleration_.resize(bars_.size());
  hoop_force_ = 0.0;
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    hoop_force_ += fem::internal_forces(bars_[b]);
    add_loads(loads_, state_.run.time, bars_[b].body, bars_[b].nodes, acceleration_[b]);
  }
}

/// Collects all nodes: they move with the grid.
void Trusses::collect() {
  transfer::TransitionNodes& to = state_.transition;
  std::size_t i = first_ = to.size();
  for (const fem::Bars& bars : bars_) {
    const fem::Nodes& from = bars.nodes;
    to.resize(i + from.size());
    const double speed = std::sqrt(bars.material.young / bars.material.density);
    for (std::size_t a = 0; a < from.size(); ++a, ++i) {
      to.mass[i] = from.mass[a];
      to.sound_speed[i] = speed;
      to.position[i] = from.position[a];
      to.velocity[i] = from.velocity[a];
      to.affine_velocity[i] = from.affine_velocity[a];
      to.force[i] = from.force[a];
    }
    state_.transition_body.resize(i, bars.body);
    state_.transition_part.resize(i, 0);
  }
}

double Trusses::critical_time_step() const {
  double dt = std::numeric_limits<double>::infinity();
  for (const fem::Bars& bars : bars_) dt = std::min(dt, fem::critical_time_step(bars));
  return dt;
}

/// Applies the motion of the grid; updates strain, work and heat of the bars.
std::string Trusses::advance() {
  const double dt = state_.run.time_step;
  const transfer::TransitionNodes& from = state_.transition;
  state_.booked.wall_impulse[1] += dt * hoop_force_;
  std::size_t i = first_;
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    fem::Bars& bars = bars_[b];
    fem::Nodes& nodes = bars.nodes;
    fem::Motion motion{.mean = std::vector<Vector3>(nodes.size()), .end = std::vector<Vector3>(nodes.size())};
    std::vector<double> heat(nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a, ++i) {
      nodes.velocity[a] = from.velocity[i];
      nodes.affine_velocity[a] = from.affine_velocity[i];
      motion.mean[a] = from.mean_velocity[i];
      motion.end[a] = from.new_velocity[i];
      state_.booked.transfer_heat += from.heat[i];
      heat[a] = from.heat[i] + from.contact_heat[i];
    }
    state_.booked.wall_impulse += afemp::stop_at_faces(nodes, state_.setup.geometry, dt, motion, heat);
    book_loads(acceleration_[b], nodes, motion, dt, state_.booked);
    const fem::BarWork done = fem::deform(bars, motion, dt);
    state_.booked.work += done.work;
    state_.booked.plastic_heat += done.plastic_heat;
    fem::add_heat(bars, heat);
    fem::move_nodes(nodes, motion, dt);
  }
  return {};
}

/// Removes the bars with an end outside of the domain.
void Trusses::remove_outside() {
  for (fem::Bars& bars : bars_) {
    std::vector<std::uint8_t> removed(bars.elements.size());
    for (std::size_t b = 0; b < removed.size(); ++b) {
      removed[b] = std::ranges::any_of(bars.elements.ends[b], [&](std::uint32_t a) {
        return state_.setup.geometry.has_left(bars.nodes.position[a]);
      });
    }
    if (std::ranges::count(removed, 1) == 0) continue;
    const Totals before = totals_of(bars, state_.particle_affine_inertia());
    fem::remove_bars(bars, removed);
    state_.book_outflow(bars.body, before, totals_of(bars, state_.particle_affine_inertia()));
  }
}

void Trusses::add_totals(Totals& sum) {
  for (const fem::Bars& bars : bars_) sum += totals_of(bars, state_.affine_inertia());
}

void Trusses::add_phases(std::span<PhaseMasses> of_body) const {
  for (const fem::Bars& bars : bars_) {
    PhaseMasses& sum = of_body[bars.body];
    for (std::size_t b = 0; b < bars.elements.size(); ++b) {
      sum.mass[static_cast<std::size_t>(Phase::solid)] += bars.elements.mass[b];
      if (bars.elements.broken[b] != 0) sum.failed += bars.elements.mass[b];
    }
  }
}

void Trusses::add_figures(Figures& figures) const {
  for (const fem::Bars& bars : bars_) {
    figures.bars += static_cast<double>(bars.elements.size());
    figures.broken_bars += static_cast<double>(std::ranges::count(bars.elements.broken, 1));
    figures.bar_energy += fem::internal_energy(bars);
    figures.elastic_energy += fem::elastic_energy(bars);
  }
}

double Trusses::largest_speed(const Vector3& frame) {
  double largest = 0.0;
  for (const fem::Bars& bars : bars_)
    largest = std::max(largest, largest_speed_of(bars.nodes.velocity, frame));
  return largest;
}

std::size_t Trusses::bytes() const {
  std::size_t bytes = 0;
  for (const fem::Bars& bars : bars_) bytes += bytes_of(bars.nodes) + bytes_of(bars.elements);
  return bytes;
}

double Trusses::mass_in(const cases::LoadedRegion& region) const {
  double mass = 0.0;
  for (const fem::Bars& bars : bars_) mass += mass_of_nodes(bars.nodes, bars.body, region);
  return mass;
}

void Trusses::for_each_point(const std::function<void(const Point& point)>& visit) const {
  for (const fem::Bars& bars : bars_) visit_nodes(bars.nodes, bars.body, state_, visit);
}

std::string Trusses::count_text(std::size_t body) const {
  for (const fem::Bars& bars : bars_) {
    if (bars.body != body) continue;
    return fmt::format("{} bars", sum_over_ranks(state_.communicator, bars.elements.size()));
  }
  return {};
}

void Trusses::keep_share() {
  const int rank = parallel::rank(state_.communicator), ranks = parallel::size(state_.communicator);
  for (fem::Bars& bars : bars_) {
    if (ranks > 1) fem::keep_share(bars, rank, ranks);
  }
  connect();
}

/// Gathers all bars on one rank; from there they are sent to the owners of their blocks.
void Trusses::gather() {
  const auto all_to_one = [&](auto& points) {
    std::vector<std::vector<std::uint32_t>> leaving(
        static_cast<std::size_t>(parallel::size(state_.communicator)));
    for (std::uint32_t i = 0; i < points.size(); ++i) leaving[rank_of_bars_in_files].push_back(i);
    exchange_rows(points, {}, leaving, state_.communicator);
  };
  for (fem::Bars& bars : bars_) {
    if (!state_.is_parallel()) continue;
    all_to_one(bars.nodes);
    all_to_one(bars.elements);
  }
  connect();
}

void Trusses::share_out() { solver::share_out(bars_, state_.grid, state_.communicator); }

void Trusses::save(Contents& contents) const {
  contents.bars = bars_;
  if (!state_.is_parallel()) return;
  for (fem::Bars& bars : contents.bars) {
    fem::migrate(bars, std::vector<int>(bars.elements.size(), rank_of_bars_in_files), state_.communicator);
  }
}

}  // namespace whipple::solver
