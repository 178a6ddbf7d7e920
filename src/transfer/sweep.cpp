// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/sweep.hpp"

#include <algorithm>

namespace whipple::transfer {
namespace {

/// Returns memory of this thread for a value of each particle of a stretch.
template <class Value>
std::span<Value> memory_of_thread(std::size_t size) {
  thread_local std::vector<Value> values;
  values.resize(std::max(values.size(), size));
  return std::span(values).first(size);
}

}  // namespace

Sweep::Sweep(grid::BlockGrid& grid, const SharedCells& shared) : grid_(grid), of_slot_(grid.slots()) {
  Range range{.number = 0, .first_slot = 0, .slots = 0, .kept = not_kept};
  std::size_t points = 0;
  Region region = Region::interior;
  const auto close = [&] {
    if (range.slots > 0) of_region_[static_cast<std::size_t>(region)].push_back(range);
  };
  for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
    const std::size_t of_slot = grid.particles_in(slot).size();
    if (points > 0 && points + of_slot > points_of_stretch) {
      close();
      range = {.number = range.number + 1, .first_slot = slot, .slots = 0, .kept = not_kept};
      points = 0;
      region = Region::interior;
    }
    ++range.slots;
    points += of_slot;
    const bool awaits =
        grid.region(slot) == Region::border || shared.divide(slot) || !grid.parts_in(slot).empty();
    if (of_slot > 0 && awaits) region = Region::border;
  }
  close();
}

void Sweep::keep_border() {
  std::size_t size = 0;
  for (Range& range : of_region_[static_cast<std::size_t>(Region::border)]) {
    range.kept = size;
    size += size_of(range);
  }
  kept_gradients_.resize(size);
  kept_volume_rates_.resize(size);
}

Stretch Sweep::stretch(const Range& range) {
  const std::size_t size = size_of(range);
  const bool is_kept = range.kept != not_kept;
  return {.number = range.number,
          .first_slot = range.first_slot,
          .particles = grid_.particles_by_block().subspan(begin_of(range), size),
          .gradients = is_kept ? std::span(kept_gradients_).subspan(range.kept, size)
                               : memory_of_thread<Matrix3>(size),
          .volume_rates = is_kept ? std::span(kept_volume_rates_).subspan(range.kept, size)
                                  : memory_of_thread<double>(size),
          .balances = std::span(of_slot_).subspan(range.first_slot, range.slots)};
}

TransferBalance Sweep::balance() const {
  TransferBalance sum;
  for (const TransferBalance& of_slot : of_slot_) sum += of_slot;
  return sum;
}

}  // namespace whipple::transfer
