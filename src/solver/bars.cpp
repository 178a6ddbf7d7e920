// SPDX-License-Identifier: BSD-3-Clause
// Bars in the time step: their nodes move with the velocity field of the grid (docs/theory/fem.md, 6;
// afemp.md, 4).
#include "src/fem/bars.hpp"

#include <algorithm>
#include <cmath>

#include "src/afemp/transition.hpp"
#include "src/case/build/bars.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

void Simulation::set_up_bars() {
  for (fem::Bars& bars : bars_) {
    bars.material = cases::bar_material(*setup_.materials[bars.body], setup_.bodies[bars.body]);
    fem::connect(bars);
  }
}

std::size_t Simulation::bar_node_count() const {
  std::size_t count = 0;
  for (const fem::Bars& bars : bars_) count += bars.nodes.size();
  return count;
}

/// The nodes that move with the grid: those of elements in transition, then all of the bars'.
void Simulation::collect_nodes() {
  afemp::collect(meshes_, transition_);
  if (setup_.transfer.particle_update != cases::ParticleUpdate::relaxed_affine) transition_.unrelaxed = 0;
  std::size_t i = transition_.size();
  for (const fem::Bars& bars : bars_) {
    const fem::Nodes& from = bars.nodes;
    transition_.resize(i + from.size());
    const double speed = std::sqrt(bars.material.young / bars.material.density);
    for (std::size_t a = 0; a < from.size(); ++a, ++i) {
      transition_.mass[i] = from.mass[a];
      transition_.sound_speed[i] = speed;
      transition_.position[i] = from.position[a];
      transition_.velocity[i] = from.velocity[a];
      transition_.affine_velocity[i] = from.affine_velocity[a];
      transition_.force[i] = from.force[a];
    }
  }
}

void Simulation::compute_bar_forces() {
  for (fem::Bars& bars : bars_) {
    fem::internal_forces(bars);
    add_gravity(bars.nodes);
  }
}

/// Takes the motion of the grid; strain, work and heat of the bars.
void Simulation::advance_bars() {
  if (bars_.empty()) return;
  const double dt = state_.time_step;
  std::size_t i = transition_.size() - bar_node_count();
  for (fem::Bars& bars : bars_) {
    fem::Nodes& nodes = bars.nodes;
    fem::Motion motion{.mean = std::vector<Vector3>(nodes.size()), .end = std::vector<Vector3>(nodes.size())};
    std::vector<double> heat(nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a, ++i) {
      nodes.velocity[a] = transition_.velocity[i];
      nodes.affine_velocity[a] = transition_.affine_velocity[i];
      motion.mean[a] = transition_.mean_velocity[i];
      motion.end[a] = transition_.new_velocity[i];
      step_.transfer_heat += transition_.heat[i];
      heat[a] = transition_.heat[i] + transition_.contact_heat[i];
    }
    step_.wall_impulse += afemp::stop_at_faces(nodes, setup_.geometry, dt, motion, heat);
    book_gravity(nodes, motion);
    step_.work += fem::deform(bars, motion, dt);
    fem::add_heat(bars, heat);
    fem::move_nodes(nodes, motion, dt);
  }
}

/// Bars with an end outside of the domain are gone.
void Simulation::remove_bars_outside() {
  for (fem::Bars& bars : bars_) {
    std::vector<std::uint8_t> removed(bars.elements.size());
    for (std::size_t b = 0; b < removed.size(); ++b) {
      removed[b] = std::ranges::any_of(bars.elements.ends[b], [&](std::uint32_t a) {
        return setup_.geometry.has_left(bars.nodes.position[a]);
      });
    }
    if (std::ranges::count(removed, 1) == 0) continue;
    const Totals before = totals_of(bars, particle_affine_inertia());
    fem::remove_bars(bars, removed);
    book_outflow(bars.body, before, totals_of(bars, particle_affine_inertia()));
  }
}

}  // namespace whipple::solver
