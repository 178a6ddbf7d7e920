// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "src/core/parallel/mpi.hpp"

namespace whipple::solver {
namespace {

/// Returns a mixed particle near a plane whose material may part from its image there; `not_mixed` if there is none.
std::uint32_t mixed_at_plane(const State& state) {
  constexpr double reach = 3.0;  // coarse cells
  const grid::Geometry& geometry = state.grid.geometry();
  const double near = reach * 2.0 * geometry.cell_size;
  const cases::ContactFields& fields = state.setup.contact_fields;
  for (const grid::MixedParticle& mixed : state.grid.mixed()) {
    const Vector3& x = state.particles.position[mixed.particle];
    const std::uint32_t body = state.particles.body[mixed.particle];
    for (const grid::MirrorPlane& plane : state.grid.mirror_planes()) {
      const auto face = static_cast<std::size_t>(plane.face);
      const double off = face % 2 == 0 ? x[plane.axis] - geometry.lower[plane.axis]
                                       : geometry.upper(plane.axis) - x[plane.axis];
      if (off < near && !state.grid.is_bonded_at(face, fields.several() ? fields.of_body[body] : 0U))
        return mixed.particle;
    }
  }
  return grid::BlockGrid::not_mixed;
}

/// Describes a node of elements or bars that moves with the grid outside of the small cells; nothing: there is none.
std::string node_outside(const State& state) {
  const std::vector<Vector3>& position = state.transition.position;
  const auto outside =
      std::ranges::find_if(position, [&](const Vector3& x) { return !state.is_in_small_cells(x); });
  if (outside == position.end()) return {};
  const Vector3& x = *outside;
  const std::uint32_t body = state.transition_body[static_cast<std::size_t>(outside - position.begin())];
  return fmt::format(
      "step {}, t = {} s, body \"{}\": a node of its elements or bars moves with the grid at ({}, {}, {}) m, "
      "which is not in "
      "small cells: a region of 'domain.refinement' should hold this place, two and a half large cells from "
      "its faces",
      state.run.step + 1, state.run.time, state.setup.bodies[body].name, x[0], x[1], x[2]);
}

}  // namespace

void stop_at_mixed(const State& state, std::uint32_t particle, const std::string& what) {
  std::string error;
  if (particle != grid::BlockGrid::not_mixed) {
    error = state.describe_particle(particle, state.run.time,
                                    what +
                                        " where the cells change their size: a region of 'domain.refinement' "
                                        "should hold this place, or none of it");
  }
  parallel::throw_together(state.communicator, error);
}

void watch_levels(State& state) {
  constexpr double strong = 0.1;  // of rho_0 c_0^2
  stop_at_mixed(state, mixed_at_plane(state), "material may part from a wall or its image");
  parallel::throw_together(state.communicator, node_outside(state));
  for (const grid::MixedParticle& mixed : state.grid.mixed()) {
    const std::uint32_t body = state.particles.body[mixed.particle];
    const double c = state.setup.materials[body]->reference.sound_speed;
    if (state.particles.pressure[mixed.particle] > strong * state.initial_density[body] * c * c)
      state.booked.shocks_at_change += 1.0;
  }
}

}  // namespace whipple::solver
