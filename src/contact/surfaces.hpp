// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "src/contact/places.hpp"
#include "src/contact/surface_points.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::contact {

/// Selects the method to determine the normal between two bodies at a node (docs/theory/contact.md, section 3).
enum class Normal : std::uint8_t {
  collinear,            ///< mean of the unit normals of both
  separating,           ///< normal of either body or their mean: the one with the largest gap
  logistic_regression,  ///< normal of the plane that best separates their particles
};
constexpr std::array<Word<Normal>, 3> words(Normal) {
  return {{{Normal::collinear, "collinear"},
           {Normal::separating, "separating"},
           {Normal::logistic_regression, "logistic_regression"}}};
}

/// Computes the surfaces of the velocity fields at the nodes of the contact slots.
class Surfaces {
 public:
  /// Describes the geometry of two fields, a before b, at a node.
  struct Gap {
    Vector3 normal = Vector3::Zero();  ///< unit vector from a to b; zero where it is not defined
    double width = 0.0;  ///< between their surfaces along the normal, m; negative where they overlap
  };

  /// Computes normals and gaps from the particles and surface points of elements that reach the nodes, with their
  /// images at mirror planes. Collective.
  /// @param dt  time step, s, if the nodes hold the sums over particles and elements; 0: not yet. Then nodes where two
  /// fields cannot be under compression are included as well.
  void find(Normal normal, transfer::ShapeFunction shape, const Particles& particles,
            const SurfacePoints& elements, grid::BlockGrid& grid, double dt);

  /// Returns normal and gap of a pair of fields at a node.
  /// @param contact_slot  number of the slot among the contact slots
  /// @param pair          pair of its bodies (`pair_index`)
  /// @param node          number of the node in its block
  /// Returns a mixed particle (docs/theory/levels.md) that reaches a node where bodies meet; `not_mixed` if there is none.
  [[nodiscard]] std::uint32_t mixed_particle(const grid::BlockGrid& grid) const;
  [[nodiscard]] Gap at(std::size_t contact_slot, std::size_t pair, std::size_t node) const;

 private:
  struct Sources;

  /// Determines the normals by planes that separate the particles of two bodies.
  template <class Shape>
  void fit_planes(const Sources& sources, grid::BlockGrid& grid);
  /// Sums the volume gradients of the bodies (eq. 3.6).
  template <class Shape>
  void sum_gradients(const Sources& sources, grid::BlockGrid& grid);
  /// Determines the normals of pairs of bodies by their volume gradients (eq. 3.5).
  void choose_normals(Normal kind, grid::BlockGrid& grid, double dt);
  /// Determines how far the bodies of a pair extend along its normals.
  template <class Shape>
  void find_extents(const Sources& sources, grid::BlockGrid& grid);

  // Of each body: gradient of its volume (x, y, z), m^2; sum of V N, m^3
  grid::ContactValues gradient_;
  grid::ContactValues normal_;  // of each pair: x, y, z of the candidate normals, one per lane
  // Of each pair, m, from the node: of a along the normals, of b in the opposite direction
  grid::ContactValues extent_;
  grid::ContactValues equations_;  // of each pair: equations of the logistic regression
  grid::ContactValues plane_;      // of each pair: current plane of the regression
};

}  // namespace whipple::contact
