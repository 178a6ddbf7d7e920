// SPDX-License-Identifier: BSD-3-Clause
// From elements to particles (docs/theory/afemp.md).
#include "src/afemp/conversion.hpp"

#include <algorithm>
#include <array>

#include "src/afemp/transition.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/solver/carriers/element_control.hpp"
#include "src/solver/carriers/hexahedra.hpp"

namespace whipple::solver {
namespace {

afemp::Thresholds thresholds(const cases::Conversion& control) {
  return {.plastic_strain = control.plastic_strain,
          .time_step_ratio = control.time_step_ratio,
          .jacobian = control.jacobian,
          .failed = control.failed};
}

}  // namespace

void Hexahedra::convert(ParticleCarrier& particles, double grid_step) {
  double converted = 0.0;
  for (fem::Mesh& mesh : meshes_) {
    const cases::Body& body = state_.setup.bodies[mesh.body];
    if (!body.discretization.converts()) continue;
    const std::vector<std::uint8_t> distorted = afemp::distorted_elements(
        mesh, thresholds(body.conversion), viscosity(state_.setup.viscosity_of(mesh.body)), grid_step);
    const auto count = static_cast<double>(std::ranges::count(distorted, 1));
    if (state_.run.step == 0) {
      std::array<double, 2> counts = {count, static_cast<double>(distorted.size())};
      parallel::sum(state_.communicator, counts);
      if (counts[0] > 0.0 && counts[0] == counts[1]) {
        log::warning(
            "body \"{}\": its thresholds turn all of its {} elements into particles in the first step",
            body.name, static_cast<std::size_t>(counts[0]));
      }
    }
    if (count == 0.0) continue;
    const afemp::ConversionBalance balance = afemp::convert_elements(
        mesh, distorted, state_.particle_affine_inertia(), state_.particles, body.discretization.lattice);
    converted += count;
    state_.booked.converted_mass += balance.mass;
    state_.booked.conversion_heat += balance.kinetic_heat;
  }
  parallel::sum(state_.communicator, std::span(&converted, 1));
  if (converted == 0.0) return;
  if (state_.keeps_losses()) use_stores(state_.particles);
  state_.particle_count += 8 * static_cast<std::size_t>(converted);
  state_.element_count -= static_cast<std::size_t>(converted);
  elements_removed();
  particles.reallocated();
}

void Hexahedra::mark_transition() {
  state_.booked.transfer_heat +=
      afemp::mark_transition(meshes_, state_.particles, state_.setup.geometry,
                             state_.particle_affine_inertia(), state_.communicator);
}

void Hexahedra::warn_of_contact() const {
  for (const fem::Mesh& mesh : meshes_) {
    double count =
        shared_nodes_.count(static_cast<std::size_t>(&mesh - meshes_.data()), mesh.nodes.in_transition);
    parallel::sum(state_.communicator, std::span(&count, 1));
    if (count == 0.0) continue;
    log::warning(
        "body \"{}\": {} nodes of its surface are within two cells of another body at the start: the bodies "
        "are in "
        "contact from the first step on",
        state_.setup.bodies[mesh.body].name, static_cast<std::size_t>(count));
  }
}

}  // namespace whipple::solver
