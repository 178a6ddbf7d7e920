// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"

/// Nodes of contact slots and the pairs of bodies there. A body has a separate velocity field, whole or divided at
/// cracks.
namespace whipple::contact {

/// Returns the index of the pair (a, b), a < b, among `bodies` bodies.
constexpr std::size_t pair_index(std::size_t a, std::size_t b, std::size_t bodies) {
  return a * (2 * bodies - a - 1) / 2 + (b - a - 1);
}

/// Describes a node of a contact slot relative to a particle, or to the image of the particle beyond a mirror plane.
struct Place {
  std::size_t contact_slot;
  std::size_t bodies;  ///< number of bodies of the slot
  std::size_t body;    ///< body of the particle, counted among those of the slot
  std::size_t node;    ///< in its block
  double weight;       ///< N
  Vector3 gradient;    ///< of N
  Vector3 distance;    ///< from the node to the particle or its image, m
  Vector3 off_plane;   ///< 0 along the normals of the mirror planes on which the node is located
  Vector3 sign;        ///< sign of each component under the reflections that lead to the image

  /// Calls f(pair, first) for the pairs that include the body of the particle; `first` states whether it is the first
  /// body.
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

/// Relevant nodes of each contact slot, one bit each.
using NodesThatMatter = std::vector<std::uint64_t>;
static_assert(grid::nodes_per_block == 64);

/// Describes a slot from the point of view of the points of a body near it.
struct SeenSlot {
  std::uint64_t nodes = 0;            ///< one bit per relevant node
  std::uint32_t contact_slot = 0;     ///< its number among the contact slots
  std::uint8_t bodies = 1, body = 0;  ///< as in Place
};

/// Returns a contact slot from the point of view of the points of a body.
inline SeenSlot seen_at_contact(const grid::BlockGrid& grid, std::size_t slot, unsigned body,
                                const NodesThatMatter& matter) {
  const std::int32_t number = grid.contact_number(slot);
  if (number == grid::BlockGrid::no_slot) return {};
  const grid::FieldSet bodies = grid.wholes(slot);
  if (!bodies.contains(body)) return {};
  return {.nodes = matter[static_cast<std::size_t>(number)],
          .contact_slot = static_cast<std::uint32_t>(number),
          .bodies = static_cast<std::uint8_t>(bodies.count()),
          .body = static_cast<std::uint8_t>(bodies.count_below(body))};
}

}  // namespace whipple::contact
