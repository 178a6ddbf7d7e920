// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/contact/surfaces.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_function.hpp"

/// Contact of bodies with velocity fields of their own (docs/theory/contact.md).
namespace whipple::contact {

struct Settings {
  Normal normal = Normal::separating;
  double friction = 0.0;  ///< Coulomb's coefficient
  bool gap_test = true;   ///< only surfaces that touch, or would within the step
  double gap = 0.0;       ///< in cells: surfaces nearer than that touch
};

/// What contact did in a step on this rank.
struct Balance {
  double contact_heat = 0.0;      ///< J, lost by the normal impulses
  double friction_heat = 0.0;     ///< J, lost by the tangential impulses
  double impulse = 0.0;           ///< N s, sum of the normal impulses
  double friction_impulse = 0.0;  ///< N s, sum of the tangential impulses
  Balance& operator+=(const Balance& other) {
    contact_heat += other.contact_heat;
    friction_heat += other.friction_heat;
    impulse += other.impulse;
    friction_impulse += other.friction_impulse;
    return *this;
  }
};

/// The impulses between velocity fields at the nodes that they share.
class Contact {
 public:
  explicit Contact(const Settings& settings) : settings_(settings) {}

  /// Finds the surfaces of the bodies around the contact slots. Collective.
  void find_surfaces(transfer::ShapeFunction shape, const Particles& particles, const SurfacePoints& elements,
                     grid::BlockGrid& grid) {
    surfaces_.find(settings_.normal, shape, particles, elements, grid);
  }

  /// Adds the impulses of contact to the velocity increments of the contact slots of this rank, and leaves
  /// the heat that they make on the nodes: what `GridUpdate::advance` calls.
  Balance apply(grid::BlockGrid& grid, double dt) const;

 private:
  Settings settings_;
  Surfaces surfaces_;
};

}  // namespace whipple::contact
