// SPDX-License-Identifier: BSD-3-Clause
// Parts of particles with functions of both levels (docs/theory/levels.md).
#include <numeric>

#include "src/core/parallel/threads.hpp"
#include "src/grid/block_reach.hpp"
#include "src/grid/point_bins.hpp"

namespace whipple::grid {

/// Finds the mixed particles and the places of their parts; returns false if a stencil reaches beyond the active set.
/// Particles in inactive blocks have not moved.
bool PointBins::locate_parts(std::span<const Vector3> position) {
  mixed_.clear();
  mixed_number_.clear();
  if (!has_two_levels()) return true;
  const auto is_mixed = [&](std::size_t p) { return geometry().blend(position[p]).is_mixed(); };
  const std::vector<std::uint32_t> found = parallel::where(position.size(), is_mixed);
  if (found.empty()) return true;
  mixed_number_.assign(position.size(), not_mixed);
  slot_of_part_.resize(2 * found.size());
  place_of_part_.resize(2 * found.size());
  const StencilPlaces places(stencil_);
  for (const std::uint32_t p : found) {
    const auto k = static_cast<std::uint32_t>(mixed_.size());
    mixed_number_[p] = k;
    mixed_.push_back({p, geometry().blend(position[p])});
    const std::optional<BlockCoordinate> coarse = block_of(position[p], Level::coarse);
    const std::int32_t of_coarse = coarse ? slot_of(*coarse) : no_slot;
    if (of_coarse == no_slot) return false;
    const auto slot = static_cast<std::size_t>(of_coarse);
    slot_of_part_[2 * k] = slot_of_particle_[p];
    place_of_part_[2 * k] = place_of_particle_[p];
    slot_of_part_[2 * k + 1] = of_coarse;
    const Lanes local = position_in_block(in_cells(position[p], slot), corner(slot), edges());
    place_of_part_[2 * k + 1] = places(local);
    const std::uint32_t touched = touched_neighbours(local, stencil_);
    reached_[slot] |= touched;
    if ((touched & ~existing(slot)) != 0) return false;
  }
  return true;
}

/// Lists the parts of particles that are listed themselves.
void PointBins::list_parts() {
  if (mixed_.empty()) return;
  std::vector<std::uint8_t> is_listed(mixed_.size(), 0);
  for (const std::uint32_t p : particles_.points) {
    if (mixed_number_[p] != not_mixed) is_listed[mixed_number_[p]] = 1;
  }
  parts_.begin.assign(slots() + 1, 0);
  for (std::size_t i = 0; i < slot_of_part_.size(); ++i) {
    parts_.begin[static_cast<std::size_t>(slot_of_part_[i]) + 1] += is_listed[i / 2];
  }
  std::partial_sum(parts_.begin.begin(), parts_.begin.end(), parts_.begin.begin());
  parts_.points.resize(parts_.begin.back());
  next_.assign(parts_.begin.begin(), parts_.begin.end() - 1);
  for (std::uint32_t i = 0; i < slot_of_part_.size(); ++i) {
    if (is_listed[i / 2] != 0) parts_.points[next_[static_cast<std::size_t>(slot_of_part_[i])]++] = i;
  }
}

/// Wakes the blocks of both parts of a mixed particle if one of them is awake: motion passes between the levels there.
/// Collective.
void PointBins::wake_both_levels(std::vector<std::uint64_t>& awake) {
  if (!has_two_levels()) return;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < mixed_.size(); ++k) {
      std::uint64_t& fine = awake[static_cast<std::size_t>(slot_of_part_[2 * k])];
      std::uint64_t& coarse = awake[static_cast<std::size_t>(slot_of_part_[2 * k + 1])];
      changed |= fine != coarse;
      fine = coarse = fine | coarse;
    }
  }
  join_bits_of_ranks(awake);
}

}  // namespace whipple::grid
