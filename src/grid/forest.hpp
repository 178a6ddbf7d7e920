// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/grid/geometry.hpp"

namespace whipple::grid {

/// A block that the particles of a rank reach, and the work that its particles are.
struct WantedBlock {
  BlockCoordinate coordinate;
  double weight;  ///< any unit, the same on all ranks
};

/// The blocks that one rank works with, numbered by slots, and whom it shares them with.
struct BlockSet {
  std::vector<BlockCoordinate>
      coordinate;         ///< own blocks along the space-filling curve, then those of others
  std::size_t owned = 0;  ///< the first so many are this rank's own
  struct Peer {
    int rank;
    std::vector<std::uint32_t> lent;      ///< own slots that the peer's particles reach
    std::vector<std::uint32_t> borrowed;  ///< slots of the peer's blocks that our particles reach
  };
  /// By rank. The order of our `lent` is that of the peer's `borrowed`.
  std::vector<Peer> peers;
};

/// p4est forest over the domain with one layer of blocks outside. A leaf at the finest level is a block;
/// coarser leaves are empty space and carry nothing, so a large domain costs nothing where there is no
/// material. The ranks own consecutive parts of the space-filling curve.
class Forest {
 public:
  /// Collective over `communicator`.
  Forest(const Geometry& geometry, MPI_Comm communicator);
  ~Forest();
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) noexcept;

  /// Refines and coarsens the forest so that exactly the blocks that any rank wants (and the siblings that
  /// refinement brings along) are finest leaves; divides the curve again if the heaviest rank has more than
  /// `imbalance` times the mean weight. Collective.
  /// @param wanted without repetition, any order
  void adapt(std::span<const WantedBlock> wanted, double imbalance = 1.02);

  /// Rank that owns a block since the last `adapt`.
  [[nodiscard]] int owner(const BlockCoordinate& block) const;

  /// Tells the owners which of their blocks this rank works with. Collective.
  /// @param wanted without repetition, any order; leaves of the forest
  [[nodiscard]] BlockSet claim(std::span<const WantedBlock> wanted) const;

  /// Leaves of this rank, all levels.
  [[nodiscard]] std::size_t leaves() const;

  struct State;  ///< p4est's objects; public for the callbacks of the implementation

 private:
  std::unique_ptr<State> state_;
};

}  // namespace whipple::grid
