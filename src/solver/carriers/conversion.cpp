// SPDX-License-Identifier: BSD-3-Clause
// Conversion of elements to particles (docs/theory/afemp.md).
#include "src/afemp/conversion.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "src/afemp/transition.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/fem/pieces.hpp"
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

afemp::ElementRange range(const cases::ElementRange& control) {
  return {.jacobian = control.jacobian,
          .time_step_ratio = control.time_step_ratio,
          .hourglass_share = control.hourglass_share,
          .speed = control.speed,
          .plastic_strain = control.plastic_strain,
          .failed = control.failed};
}

}  // namespace

void Hexahedra::convert(ParticleCarrier& particles, double grid_step) {
  std::array<double, 2> counts = {0.0, 0.0};  // of elements converted to particles, and deleted
  const std::size_t parts = state_.setup.geometry.is_planar() ? 4 : 8;
  std::string error;
  for (fem::Mesh& mesh : meshes_) {
    const cases::Body& body = state_.setup.bodies[mesh.body];
    const fem::ViscosityCoefficients viscosities = viscosity(state_.setup.viscosity_of(mesh.body));
    if (body.discretization.converts()) {
      const std::vector<std::uint8_t> distorted =
          afemp::distorted_elements(mesh, thresholds(body.conversion), viscosities, grid_step);
      warn_of_all(mesh, distorted);
      counts[0] += static_cast<double>(convert(mesh, distorted, error));
    }
    const std::vector<afemp::RangeFault> faults =
        afemp::range_faults(mesh, range(body.element_range), viscosities, grid_step);
    std::vector<std::uint8_t> beyond(faults.size());
    std::ranges::transform(faults, beyond.begin(),
                           [](afemp::RangeFault fault) { return fault != afemp::RangeFault::none ? 1 : 0; });
    const auto count = static_cast<double>(std::ranges::count(beyond, 1));
    if (count == 0.0) continue;
    state_.booked.elements_beyond_range += count;
    const bool stops = body.element_range.beyond == cases::BeyondRange::stop;
    std::vector<std::string> told;
    for (std::size_t e = 0; e < faults.size(); ++e) {
      // Erosion is the rule where it is asked for: counted, not told one by one.
      if (beyond[e] == 0 || (afemp::is_of_material(faults[e]) && !stops)) continue;
      told.push_back(
          describe(mesh, e * fem::points_per_element(mesh.quadrature), std::string(word_of(faults[e]))));
    }
    switch (body.element_range.beyond) {
      case cases::BeyondRange::particles:
        for (const std::string& text : told) log::detail("{}\n  it becomes particles", text);
        counts[0] += static_cast<double>(convert(mesh, beyond, error));
        break;
      case cases::BeyondRange::remove:
        for (const std::string& text : told) log::info("{}\n  it is deleted", text);
        state_.booked.removed_mass += remove(mesh, beyond);
        counts[1] += count;
        break;
      case cases::BeyondRange::stop:
        if (error.empty()) error = told.front();
        break;
    }
  }
  parallel::sum(state_.communicator, std::span(counts));
  if (counts[0] + counts[1] > 0.0) {
    if (state_.keeps_losses()) use_stores(state_.particles);
    state_.particle_count += parts * static_cast<std::size_t>(counts[0]);
    state_.element_count -= static_cast<std::size_t>(counts[0] + counts[1]);
    elements_removed();
    particles.reallocated();
  }
  // At the end, so that the saved state of a failed run is complete.
  parallel::throw_together(state_.communicator, error);
}

/// Converts the chosen elements, or describes in `error` one that is not in small cells, where its particles would lose
/// their affine fields (docs/theory/levels.md, 5).
/// @returns number of converted elements
std::size_t Hexahedra::convert(fem::Mesh& mesh, std::span<const std::uint8_t> chosen, std::string& error) {
  for (std::size_t e = 0; e < chosen.size(); ++e) {
    if (chosen[e] == 0 || std::ranges::all_of(mesh.elements.corners[e], [&](std::uint32_t a) {
          return state_.is_in_small_cells(mesh.nodes.position[a]);
        }))
      continue;
    if (error.empty()) {
      error =
          describe(mesh, e * fem::points_per_element(mesh.quadrature),
                   "it becomes particles, and is not in small cells: a region of 'domain.refinement' should "
                   "hold this place");
    }
    return 0;
  }
  const afemp::ConversionBalance balance =
      afemp::convert_elements(mesh, chosen, state_.particle_affine_inertia(), state_.particles,
                              state_.setup.bodies[mesh.body].discretization.lattice);
  state_.booked.converted_mass += balance.mass;
  state_.booked.conversion_heat += balance.kinetic_heat;
  return balance.elements;
}

void Hexahedra::warn_of_all(const fem::Mesh& mesh, std::span<const std::uint8_t> distorted) const {
  if (state_.run.step != 0) return;
  std::array<double, 2> counts = {static_cast<double>(std::ranges::count(distorted, 1)),
                                  static_cast<double>(distorted.size())};
  parallel::sum(state_.communicator, counts);
  if (counts[0] == 0.0 || counts[0] != counts[1]) return;
  log::warning("body \"{}\": its thresholds turn all of its {} elements into particles in the first step",
               state_.setup.bodies[mesh.body].name, static_cast<std::size_t>(counts[0]));
}

/// Finds the parts of bodies that have velocity fields of their own. Collective.
void Hexahedra::find_parts() {
  if (!std::exchange(pieces_changed_, false)) return;
  const cases::ContactFields& fields = state_.setup.contact_fields;
  std::vector<std::uint8_t> wanted;
  for (const fem::Mesh& mesh : meshes_) wanted.push_back(fields.parts(mesh.body) > 1 ? 1 : 0);
  const std::vector<fem::Pieces> found =
      fem::find_pieces(meshes_, wanted, shared_nodes_, state_.communicator);
  parts_.assign(meshes_.size(), {});
  part_counts_.assign(meshes_.size(), 1);
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    if (found[m].count < 2) continue;
    const unsigned further = fields.parts(meshes_[m].body) - 1;
    part_counts_[m] = std::min<std::size_t>(found[m].count, 1 + further);
    for (const std::uint32_t piece : found[m].of_node) {
      parts_[m].push_back(static_cast<std::uint8_t>(piece == 0 ? 0 : 1 + (piece - 1) % further));
    }
  }
}

void Hexahedra::mark_transition() {
  find_parts();
  state_.booked.transfer_heat +=
      afemp::mark_transition(meshes_, {.of_node = parts_, .count = part_counts_}, state_.particles,
                             state_.setup.geometry, state_.particle_affine_inertia(), state_.communicator);
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
