// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/grid/block_grid.hpp"

namespace whipple::contact {

/// Returns whether particles reach nodes of a slot from both sides of a mirror plane, so that their sums are
/// folded later.
bool near_planes(const grid::BlockGrid& grid, std::uint32_t slot);

/// Returns whether two bodies, the only ones at a node and whole, separate along all candidate normals without being
/// compressed by the forces; then there is no impulse, whatever the gap (docs/theory/contact.md, 4).
/// @param a, b  numbers of the bodies among those of the slot
bool parts(const grid::BlockGrid& grid, std::uint32_t slot, std::size_t node, std::size_t a, std::size_t b,
           std::span<const Vector3> normals, double dt);

}  // namespace whipple::contact
