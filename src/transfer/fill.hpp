// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::transfer {

/// Computes the fraction of the cells around each particle that material of all bodies, voids that it holds included, and its
/// images at mirror planes fill: phi_p = sum N_i phi_i, phi_i = sum V_p N_i / dx^3 (docs/theory/contact.md,
/// 7). Infinite where nodes of elements are near, whose volume is not on the grid, and for particles that
/// rest or fly. Particles must be binned; node contents are lost. Collective; bitwise independent of the
/// number of threads.
std::vector<double> fill_of_cells(const Particles& particles, const TransitionNodes& nodes,
                                  grid::BlockGrid& grid);

}  // namespace whipple::transfer
