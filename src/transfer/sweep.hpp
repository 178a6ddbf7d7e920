// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/shared_cells.hpp"
#include "src/transfer/transfer_balance.hpp"

/// The order in which a step visits the particles of a rank: stretch by stretch, region by region.
namespace whipple::transfer {

using Region = grid::BlockGrid::Region;

/// The particles that one thread works on at a time, from the gather to the new stress: those of slots that follow one
/// another. What gather and material read and write of them, some 500 bytes of each, stays in the second-level cache.
struct Stretch {
  std::size_t number;                        ///< in the order of the slots
  std::size_t first_slot;                    ///< of those that follow one another
  std::span<const std::uint32_t> particles;  ///< as the grid lists them
  std::span<Matrix3>
      gradients;  ///< 1/s, L(i, j) = dv_i/dx_j of each particle: memory of the thread, unless kept
  std::span<double>
      volume_rates;  ///< 1/s, div (v^n + v^{n+1})/2 of each particle, in the symplectic scheme: likewise
  std::span<TransferBalance> balances;  ///< of each slot
};

/// All particles on the grid in stretches, as they are binned now; `bin` and `separate_fields` end it. Sums over the
/// particles are taken slot by slot, so that they do not depend on threads or regions.
class Sweep {
 public:
  /// Particles of a stretch, at most: a fuller slot is alone.
  static constexpr std::size_t points_of_stretch = 512;

  /// @param shared  cells whose particles belong to the border wherever they are
  explicit Sweep(grid::BlockGrid& grid, const SharedCells& shared = {});

  /// Calls work(stretch) on threads for the stretches of a region. A stretch belongs to the border if particles of any of
  /// its slots do (grid::BlockGrid::Region): what the nodes of the border await from other ranks may be under way while
  /// the interior is worked on.
  template <class Work>
  void for_each_stretch(Region region, Work&& work) {
    const std::vector<Range>& ranges = of_region_[static_cast<std::size_t>(region)];
    parallel::for_each_uneven(ranges.size(), [&](std::size_t i) {
      if (region == Region::interior) grid_.progress();
      work(stretch(ranges[i]));
    });
  }

  /// Gives the stretches of the border memory of their own: what one pass over them gathers is there in the next.
  void keep_border();

  /// Returns the number of stretches, of both regions.
  [[nodiscard]] std::size_t stretches() const { return of_region_[0].size() + of_region_[1].size(); }
  /// Returns the sum of the balances of all slots.
  [[nodiscard]] TransferBalance balance() const;

 private:
  struct Range {
    std::size_t number, first_slot, slots;
    std::size_t kept;  ///< begin in the memory of the border; `not_kept` while it has none
  };
  static constexpr std::size_t not_kept = static_cast<std::size_t>(-1);
  [[nodiscard]] std::size_t begin_of(const Range& range) const { return grid_.place_of(range.first_slot); }
  [[nodiscard]] std::size_t size_of(const Range& range) const {
    return grid_.place_of(range.first_slot + range.slots) - begin_of(range);
  }
  [[nodiscard]] Stretch stretch(const Range& range);

  grid::BlockGrid& grid_;
  std::array<std::vector<Range>, 2> of_region_;
  std::vector<TransferBalance> of_slot_;
  std::vector<Matrix3> kept_gradients_;
  std::vector<double> kept_volume_rates_;
};

}  // namespace whipple::transfer
