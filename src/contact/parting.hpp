// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/grid/block_grid.hpp"

namespace whipple::contact {

/// Returns whether particles may reach nodes of a slot from both sides of a mirror plane, so that their sums are not
/// yet folded.
bool near_planes(const grid::BlockGrid& grid, std::uint32_t slot);

/// Returns whether the only two bodies at a node, both undivided, separate along all candidate normals and are not
/// compressed by the forces; then there is no impulse, whatever the gap (docs/theory/contact.md, section 4).
/// @param a, b  numbers of the bodies among those of the slot
bool parts(const grid::BlockGrid& grid, std::uint32_t slot, std::size_t node, std::size_t a, std::size_t b,
           std::span<const Vector3> normals, double dt);

}  // namespace whipple::contact
