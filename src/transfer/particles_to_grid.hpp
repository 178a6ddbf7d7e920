// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::transfer {

/// Mass, momentum (with the affine field), internal force and mass-weighted sound speed of the particles on
/// the nodes (docs/theory/mpm.md, equations 3.1 to 3.3). Clears the grid first; mirror planes are not folded
/// yet. The result is bitwise independent of the number of threads.
template <class Shape>
void particles_to_grid(const Particles& particles, grid::BlockGrid& grid);

/// Momentum only: Node::first is replaced, Node::second stays (second pass of MUSL, equation 5.4).
template <class Shape>
void momentum_to_grid(const Particles& particles, grid::BlockGrid& grid);

}  // namespace whipple::transfer
