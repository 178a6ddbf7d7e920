// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "src/contact/cracks.hpp"
#include "src/contact/first_touches.hpp"
#include "src/contact/node_fields.hpp"
#include "src/contact/surfaces.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

/// Contact of bodies with separate velocity fields (docs/theory/contact.md).
namespace whipple::contact {

/// Selects the response of bodies at a node where their surfaces touch.
enum class Response : std::uint8_t {
  common_field,  ///< under compression the bodies have a common velocity along the normal
  impulses,      ///< each body keeps its velocity; impulses stop the approach
};

struct Settings {
  Response response = Response::common_field;
  Normal normal = Normal::separating;
  double friction = 0.3;  ///< Coulomb coefficient
  /// Coulomb coefficient of each velocity field, if they differ; the smaller of the two values applies.
  std::vector<double> friction_of_field = {};
  double crack_friction = 0.3;  ///< Coulomb coefficient of the faces of a crack
  bool gap_test = true;         ///< contact only where surfaces touch, or would within the step
  double gap = 0.0;             ///< in cells: surfaces closer than this touch
  /// Minimum relaxation rate of each velocity field, 1/s. Where a field relaxes more slowly, its material is too
  /// fragmented to move with a common velocity, and impulses stop it. Empty: no minimum.
  std::vector<double> least_relaxation_rate;
};

/// Computes the contact between velocity fields at the nodes that they share.
class Contact {
 public:
  explicit Contact(Settings settings) : settings_(std::move(settings)) {}

  /// Finds the surfaces of the bodies around the contact slots. Collective.
  /// @param dt  time step, s, if the nodes hold the sums over particles and elements; 0: not yet
  void find_surfaces(transfer::ShapeFunction shape, const Particles& particles, const SurfacePoints& elements,
                     grid::BlockGrid& grid, double dt) {
    surfaces_.find(settings_.normal, shape, particles, elements, grid, dt);
  }

  /// Returns whether the surfaces of two fields, by their numbers in a contact slot, touch at a node.
  [[nodiscard]] bool touch(const grid::BlockGrid& grid, std::size_t contact_slot, std::size_t node,
                           std::size_t first, std::size_t second) const;

  /// Applies contact between the bodies at the nodes of this rank's contact slots: changes velocities, increments and
  /// relaxations and stores the contact dissipation as heat of the nodes. Call between `GridUpdate::solve_momentum` and
  /// `share_step`.
  /// @param touches  records the fields that touch
  /// @param cracks   cracks of the bodies whose fields are divided; null: there are none
  /// @returns dissipation and impulses of the step on this rank
  Balance apply(grid::BlockGrid& grid, double dt, FirstTouches& touches,
                const Cracks* cracks = nullptr) const;

  /// Returns a particle with functions of two cell sizes where bodies meet; BlockGrid::not_mixed: none. Requires surfaces.
  [[nodiscard]] std::uint32_t mixed_particle(const grid::BlockGrid& grid) const {
    return surfaces_.mixed_particle(grid);
  }

 private:
  [[nodiscard]] double friction_between(unsigned first, unsigned second) const;
  [[nodiscard]] double distance(double cell_size, double gap) const;

  Settings settings_;
  Surfaces surfaces_;
};

}  // namespace whipple::contact
