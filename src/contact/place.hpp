// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "src/core/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"

/// A node of a contact slot, and the pairs of bodies there. A body is what has a velocity field of its own, whole or
/// divided at cracks.
namespace whipple::contact {

/// Number of the pair (a, b), a < b, of `bodies` bodies.
constexpr std::size_t pair_index(std::size_t a, std::size_t b, std::size_t bodies) {
  return a * (2 * bodies - a - 1) / 2 + (b - a - 1);
}

/// A node of a contact slot as a particle, or its image beyond a mirror plane, sees it.
struct Place {
  std::size_t contact_slot;
  std::size_t bodies;  ///< of the slot
  std::size_t body;    ///< of the particle, counted among those of the slot
  std::size_t node;    ///< in its block
  double weight;       ///< N
  Vector3 gradient;    ///< of N
  Vector3 distance;    ///< position of the particle, or its image, minus that of the node
  Vector3 off_plane;   ///< 0 along the normals of the mirror planes that the node is on
  Vector3 sign;        ///< of the components under the reflections that lead to the image

  /// Calls f(pair, is the particle of its first body?) for the pairs that the particle's body is part of.
  template <class Function>
  void for_each_pair(Function&& f) const {
    for (std::size_t other = 0; other < bodies; ++other) {
      if (other < body) f(pair_index(other, body, bodies), false);
      if (other > body) f(pair_index(body, other, bodies), true);
    }
  }
  [[nodiscard]] std::size_t in(const grid::ContactValues& values, std::size_t array,
                               std::size_t lanes = 1) const {
    return values.begin[contact_slot] + lanes * (array * grid::nodes_per_block + node);
  }
};

}  // namespace whipple::contact
