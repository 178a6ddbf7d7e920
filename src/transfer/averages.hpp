// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/averaged_bodies.hpp"
#include "src/transfer/shared_cells.hpp"
#include "src/transfer/sweep.hpp"

/// Averages of pressure and volume rate over the particles of a body in a cell, against locking of material that keeps
/// its volume (docs/theory/mpm.md, 4.12 to 4.14). A cell has its corners at nodes; its particles are in one slot of the
/// grid. Where other ranks have particles of the slot (SharedCells), the means are those over the particles of all ranks.
namespace whipple::transfer {

/// Computes the mean stress (Pa, positive in tension) by which every particle on the grid acts on its nodes: minus
/// pressure and artificial viscosity, of averaged bodies their mean over the cell by volume (4.12). Collective.
/// @param mean_stress  of all particles
void average_stress(const Particles& particles, grid::BlockGrid& grid, const AveragedBodies& bodies,
                    SharedCells& shared, std::span<double> mean_stress);

/// Sums the volume rates of a stretch in the cells that ranks share, which must have been cleared. When all stretches
/// with such cells are done, SharedCells::add_ranks makes the sums those of all ranks.
void sum_volume_rate(const Particles& particles, const grid::BlockGrid& grid, const AveragedBodies& bodies,
                     SharedCells& shared, const Stretch& stretch);
/// Replaces the trace of the velocity gradients of a stretch by its mean over the cell (4.13), for particles of averaged
/// bodies.
void average_volume_rate(const Particles& particles, const grid::BlockGrid& grid,
                         const AveragedBodies& bodies, SharedCells& shared, const Stretch& stretch);
/// Does the same after the gather of the symplectic scheme, and replaces in the internal energy the work on the own
/// volume rate by that on the mean one (4.14). The sum over a cell is then minus the power of the averaged stress.
/// @param dt  s
void average_volume_rate_and_work(Particles& particles, const grid::BlockGrid& grid,
                                  const AveragedBodies& bodies, SharedCells& shared, const Stretch& stretch,
                                  double dt);

}  // namespace whipple::transfer
