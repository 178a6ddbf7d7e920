// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/core/base/vector_math.hpp"
#include "src/grid/topology.hpp"

/// Neighbour blocks that the stencil of a particle reaches.
namespace whipple::grid {

/// Reach along one direction: bit 0 for the block before, bit 1 for the block after.
using AxisReach = unsigned;

/// Returns, for each reach given by direction, one bit per neighbour, the block itself included.
constexpr std::array<std::uint32_t, 64> neighbour_masks() {
  std::array<std::uint32_t, 64> masks{};
  for (unsigned reach = 0; reach < 64; ++reach) {
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        for (int z = 0; z < 3; ++z) {
          const auto touched = [](AxisReach axis, int offset) {
            return offset == 1 || (offset == 0 && (axis & 1U) != 0) || (offset == 2 && (axis & 2U) != 0);
          };
          if (touched(reach & 3U, x) && touched(reach >> 2 & 3U, y) && touched(reach >> 4, z)) {
            masks[reach] |= 1U << neighbour_index(x, y, z);
          }
        }
      }
    }
  }
  return masks;
}
constexpr std::array<std::uint32_t, 64> reach_masks = neighbour_masks();

/// Returns masks of neighbour blocks by direction masks: bits 0 to 2 for the directions in which the block before is
/// reached, bits 3 to 5 for those in which the block after is reached.
constexpr std::array<std::uint32_t, 64> masks_by_direction() {
  std::array<std::uint32_t, 64> by_direction{};
  for (unsigned bits = 0; bits < 64; ++bits) {
    unsigned reach = 0;
    for (unsigned a = 0; a < 3; ++a) reach |= ((bits >> a & 1U) | (bits >> (a + 3) & 1U) << 1U) << (2 * a);
    by_direction[bits] = reach_masks[reach];
  }
  return by_direction;
}

/// Returns the neighbours that contain nodes of stencils whose first nodes are between two corners of a box (cells from
/// the block's lower corner; directions in lanes).
inline std::uint32_t touched_neighbours_of_box(Lanes first, Lanes last, Stencil stencil) {
  static constexpr std::array<std::uint32_t, 64> by_direction = masks_by_direction();
  const unsigned directions = stencil.planar ? 3U : 7U;
  const unsigned before = bits(first < 0.0) & directions;
  const unsigned after = bits(last > static_cast<double>(stencil.block().edge - stencil.count)) & directions;
  return by_direction[before | after << 3U];
}
/// Returns the neighbours that contain nodes of the stencil of a particle at `local` (cells from the block's lower
/// corner; directions in lanes), during `ahead` cells of motion and within `around` cells on either side.
inline std::uint32_t touched_neighbours(Lanes local, Lanes ahead, Stencil stencil, double around = 0.0) {
  const auto first_node = [&](Lanes at) { return floor(at - stencil.shift); };
  return touched_neighbours_of_box(first_node(local + minimum(ahead, broadcast(-around))),
                                   first_node(local + maximum(ahead, broadcast(around))), stencil);
}
/// Returns the neighbour blocks that the stencil of a stationary particle reaches.
inline std::uint32_t touched_neighbours(Lanes local, Stencil stencil) {
  return touched_neighbours(local, Lanes{}, stencil);
}

}  // namespace whipple::grid
