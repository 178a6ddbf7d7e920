// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

#include "src/grid/geometry.hpp"

namespace whipple::grid {

/// p4est forest over the domain with one layer of blocks outside. A leaf at the finest level is a block;
/// coarser leaves are empty space and carry nothing, so a large domain costs nothing where there is no
/// matter.
class Forest {
 public:
  /// Collective over `communicator`.
  Forest(const Geometry& geometry, MPI_Comm communicator);
  ~Forest();
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) noexcept;

  /// Refines and coarsens the forest so that exactly the wanted blocks (and the siblings that refinement
  /// brings along) are finest leaves. Collective.
  /// @param wanted blocks that must exist, any order, without repetition
  /// @returns the wanted blocks in the order of the forest's space-filling curve
  std::vector<BlockCoordinate> adapt(std::span<const BlockCoordinate> wanted);

  /// Leaves of this rank, all levels.
  [[nodiscard]] std::size_t leaves() const;

  struct State;  ///< p4est's objects; public for the callbacks of the implementation

 private:
  std::unique_ptr<State> state_;
};

}  // namespace whipple::grid
