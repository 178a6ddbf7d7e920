// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/sweep.hpp"

/// Averages of pressure and volume rate over the particles of a body in a cell, against locking of material that keeps
/// its volume (docs/theory/mpm.md, 4.12 to 4.14). A cell has its corners at nodes; its particles are in one slot of the grid. On several ranks
/// those of a cell may be on two, which is refused (`Transfers`).
namespace whipple::transfer {

/// Holds which bodies of a run are averaged.
class AveragedBodies {
 public:
  explicit AveragedBodies(std::vector<std::uint8_t> is_averaged);
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] bool contain(std::uint32_t body) const { return is_averaged_[body] != 0; }

 private:
  std::vector<std::uint8_t> is_averaged_;  // of each body
  bool any_;
};

/// Computes the mean stress (Pa, positive in tension) by which every particle on the grid acts on its nodes: minus
/// pressure and artificial viscosity, of averaged bodies their mean over the cell by volume (4.12).
/// @param mean_stress  of all particles
void average_stress(const Particles& particles, const grid::BlockGrid& grid, const AveragedBodies& bodies,
                    std::span<double> mean_stress);

/// Replaces the trace of the velocity gradients of a stretch by its mean over the cell (4.13), for particles of averaged
/// bodies.
void average_volume_rate(const Particles& particles, const grid::BlockGrid& grid,
                         const AveragedBodies& bodies, const Stretch& stretch);
/// Does the same after the gather of the symplectic scheme, and replaces in the internal energy the work on the own
/// volume rate by that on the mean one (4.14). The sum over a cell is then minus the power of the averaged stress.
/// @param dt  s
void average_volume_rate_and_work(Particles& particles, const grid::BlockGrid& grid,
                                  const AveragedBodies& bodies, const Stretch& stretch, double dt);

}  // namespace whipple::transfer
