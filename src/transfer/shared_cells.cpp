// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/shared_cells.hpp"

#include <algorithm>

#include "src/core/parallel/threads.hpp"

namespace whipple::transfer {

void SharedCells::find(const Particles& particles, grid::BlockGrid& grid, const AveragedBodies& bodies) {
  if (!bodies.any() || !grid.is_shared()) return;
  const std::size_t slots = grid.slots(), of_slot = (bodies.count() + lanes - 1) / lanes;
  ranks_.begin.resize(slots + 1);
  for (std::size_t s = 0; s <= slots; ++s) ranks_.begin[s] = static_cast<std::uint32_t>(s * of_slot);
  ranks_.values.assign(slots * of_slot, Lanes{});
  parallel::for_each_uneven(slots, [&](std::size_t s) {
    for_each_averaged_body(particles, grid.particles_in(s), bodies,
                           [&](std::uint32_t body, std::size_t, std::span<const std::uint32_t>) {
                             const std::size_t number = bodies.number(body);
                             ranks_.values[ranks_.begin[s] + number / lanes][number % lanes] = 1.0;
                           });
  });
  grid.sum_to_owners(ranks_);
  grid.borrow_from_owners(ranks_);
  sums_.begin.assign(slots + 1, 0);
  for (std::size_t s = 0; s < slots; ++s) {
    std::uint32_t divided = 0;
    for (std::size_t number = 0; number < bodies.count(); ++number) divided += is_divided(s, number) ? 1 : 0;
    sums_.begin[s + 1] = sums_.begin[s] + divided * grid::nodes_per_block;
  }
  sums_.values.resize(sums_.begin.back());
}

std::span<Lanes> SharedCells::of(std::size_t slot, std::size_t number) {
  if (!divide(slot) || !is_divided(slot, number)) return {};
  std::size_t begin = sums_.begin[slot];
  for (std::size_t before = 0; before < number; ++before) {
    if (is_divided(slot, before)) begin += grid::nodes_per_block;
  }
  return std::span(sums_.values).subspan(begin, grid::nodes_per_block);
}

void SharedCells::clear() { std::ranges::fill(sums_.values, Lanes{}); }

void SharedCells::add_ranks(grid::BlockGrid& grid) {
  if (sums_.begin.empty()) return;
  grid.sum_to_owners(sums_);
  grid.borrow_from_owners(sums_);
}

}  // namespace whipple::transfer
