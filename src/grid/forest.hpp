// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/grid/geometry.hpp"

namespace whipple::grid {

/// Describes a block that the particles of a rank reach, and the work of its particles.
struct WantedBlock {
  BlockCoordinate coordinate;
  double weight;  ///< in any unit common to all ranks
};

/// Describes the blocks that a rank uses, numbered by slots, and the ranks that share them.
struct BlockSet {
  std::vector<BlockCoordinate> coordinate;  ///< own blocks along the space-filling curve, then ghost blocks
  std::size_t owned = 0;                    ///< number of this rank's own blocks, which come first
  struct Peer {
    int rank;
    std::vector<std::uint32_t> lent;      ///< own slots that the peer's particles reach
    std::vector<std::uint32_t> borrowed;  ///< slots of the peer's blocks that our particles reach
  };
  /// Ordered by rank. The order of our `lent` equals that of the peer's `borrowed`.
  std::vector<Peer> peers;
};

/// Manages the p4est forest over the domain with one layer of blocks outside. A leaf at the finest level is a block;
/// coarser leaves are empty space without data, so that a large domain costs nothing where there is no material. The
/// ranks own consecutive sections of the space-filling curve.
class Forest {
 public:
  /// Creates a forest without blocks. Collective over `communicator`.
  Forest(const Geometry& geometry, MPI_Comm communicator);
  ~Forest();
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) noexcept;

  /// Refines and coarsens the forest so that the blocks requested by any rank (and their siblings by refinement) are
  /// exactly the finest leaves; repartitions the curve if the maximum weight of a rank exceeds `imbalance` times the
  /// mean. Collective.
  /// @param wanted without repetition, any order
  void adapt(std::span<const WantedBlock> wanted, double imbalance = 1.02);

  /// Returns the rank that owns a block since the last `adapt`.
  [[nodiscard]] int owner(const BlockCoordinate& block) const;

  /// Registers the blocks that this rank uses with their owners. Collective.
  /// @param wanted without repetition, any order; leaves of the forest
  [[nodiscard]] BlockSet claim(std::span<const WantedBlock> wanted) const;

  /// Returns the number of leaves of this rank, all levels.
  [[nodiscard]] std::size_t leaves() const;

  struct State;  ///< p4est's objects; public for the callbacks of the implementation

 private:
  std::unique_ptr<State> state_;
};

}  // namespace whipple::grid
