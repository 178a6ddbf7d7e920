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

/// Method to determine the normal between two bodies at a node (docs/theory/contact.md, 3).
enum class Normal : std::uint8_t {
  collinear,            ///< mean of the unit normals of both
  separating,           ///< of one body, the other, or their mean: along which they are farthest apart
  logistic_regression,  ///< of the plane that separates their particles best
};
constexpr std::array<Word<Normal>, 3> words(Normal) {
  return {{{Normal::collinear, "collinear"},
           {Normal::separating, "separating"},
           {Normal::logistic_regression, "logistic_regression"}}};
}

/// Surfaces of the velocity fields at the nodes of the contact slots.
class Surfaces {
 public:
  /// Geometry of two fields, a before b, at a node.
  struct Gap {
    Vector3 normal = Vector3::Zero();  ///< unit, from a to b; zero where it is not defined
    double width = 0.0;                ///< m, between their surfaces along it; negative where they overlap
  };

  /// From the particles and the surfaces of elements that reach the nodes, with their images at mirror
  /// planes. Collective.
  /// @param dt  s, of the step, if the nodes hold what particles and elements brought to them; 0: not yet.
  /// Then nodes
  ///            count where two fields cannot press either.
  void find(Normal normal, transfer::ShapeFunction shape, const Particles& particles,
            const SurfacePoints& elements, grid::BlockGrid& grid, double dt);

  /// @param contact_slot  number of the slot among the contact slots
  /// @param pair          of its fields: see `pair_index`
  /// @param node          in its block
  [[nodiscard]] Gap at(std::size_t contact_slot, std::size_t pair, std::size_t node) const;

 private:
  grid::ContactValues gradient_;   // of each field: of its volume (x y z), m^2
  grid::ContactValues normal_;     // of each pair: x, y, z of the normals that are tried, one in each lane
  grid::ContactValues extent_;     // of each pair: of a along them, of b against them, from the node (m)
  grid::ContactValues equations_;  // of each pair: of the logistic regression
  grid::ContactValues plane_;      // of each pair: its present solution
};

}  // namespace whipple::contact
