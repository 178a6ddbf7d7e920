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

/// Contact of bodies with velocity fields of their own (docs/theory/contact.md).
namespace whipple::contact {

/// Response of bodies at a node where their surfaces touch.
enum class Response : std::uint8_t {
  common_field,  ///< while they press they have one velocity along the normal
  impulses,      ///< each has its own, and impulses stop them
};

struct Settings {
  Response response = Response::common_field;
  Normal normal = Normal::separating;
  double friction = 0.3;  ///< Coulomb's coefficient
  std::vector<double> friction_of_field =
      {};                       ///< of each velocity field, if they differ: of two the lesser one acts
  double crack_friction = 0.3;  ///< of the faces of a crack
  bool gap_test = true;         ///< only surfaces that touch, or would within the step
  double gap = 0.0;             ///< in cells: surfaces nearer than that touch
  /// 1/s, of each velocity field: where it relaxes more slowly, its material is too loose to move as one with
  /// what it meets, and impulses stop it; empty: never
  std::vector<double> least_relaxation_rate;
};

/// The impulses between velocity fields at the nodes that they share.
class Contact {
 public:
  explicit Contact(Settings settings) : settings_(std::move(settings)) {}

  /// Finds the surfaces of the bodies around the contact slots. Collective.
  /// @param dt  s, if the nodes hold what particles and elements brought to them; 0: not yet
  void find_surfaces(transfer::ShapeFunction shape, const Particles& particles, const SurfacePoints& elements,
                     grid::BlockGrid& grid, double dt) {
    surfaces_.find(settings_.normal, shape, particles, elements, grid, dt);
  }

  /// Returns whether the surfaces of two fields, by their numbers in a contact slot, touch at a node.
  [[nodiscard]] bool touch(const grid::BlockGrid& grid, std::size_t contact_slot, std::size_t node,
                           std::size_t first, std::size_t second) const;

  /// Lets the bodies act on one another at the nodes of the contact slots of this rank, by their velocities,
  /// increments and relaxations, and leaves the heat that it makes there: between `GridUpdate::solve_momentum` and `share_step`.
  /// @param touches  takes note of the fields that touch
  /// @param cracks   of bodies whose fields divide at them; null: of none
  Balance apply(grid::BlockGrid& grid, double dt, FirstTouches& touches,
                const Cracks* cracks = nullptr) const;

 private:
  [[nodiscard]] double friction_between(unsigned first, unsigned second) const;
  [[nodiscard]] double distance(const grid::BlockGrid& grid, double gap) const;

  Settings settings_;
  Surfaces surfaces_;
};

}  // namespace whipple::contact
