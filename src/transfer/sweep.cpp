// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/sweep.hpp"

#include <algorithm>

namespace whipple::transfer {
namespace {

/// Returns memory of this thread for the gradients of a stretch.
std::span<Matrix3> gradients_of_thread(std::size_t size) {
  thread_local std::vector<Matrix3> gradients;
  gradients.resize(std::max(gradients.size(), size));
  return std::span(gradients).first(size);
}

}  // namespace

Sweep::Sweep(grid::BlockGrid& grid) : grid_(grid), of_slot_(grid.slots()) {
  Range range{.number = 0, .first_slot = 0, .slots = 0};
  std::size_t points = 0;
  Region region = Region::interior;
  const auto close = [&] {
    if (range.slots > 0) of_region_[static_cast<std::size_t>(region)].push_back(range);
  };
  for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
    const std::size_t of_slot = grid.particles_in(slot).size();
    if (points > 0 && points + of_slot > points_of_stretch) {
      close();
      range = {.number = range.number + 1, .first_slot = slot, .slots = 0};
      points = 0;
      region = Region::interior;
    }
    ++range.slots;
    points += of_slot;
    if (of_slot > 0 && grid.region(slot) == Region::border) region = Region::border;
  }
  close();
}

Stretch Sweep::stretch(const Range& range) {
  const std::size_t begin = grid_.place_of(range.first_slot),
                    size = grid_.place_of(range.first_slot + range.slots) - begin;
  return {.number = range.number,
          .first_slot = range.first_slot,
          .particles = grid_.particles_by_block().subspan(begin, size),
          .gradients = gradients_of_thread(size),
          .balances = std::span(of_slot_).subspan(range.first_slot, range.slots)};
}

TransferBalance Sweep::balance() const {
  TransferBalance sum;
  for (const TransferBalance& of_slot : of_slot_) sum += of_slot;
  return sum;
}

}  // namespace whipple::transfer
