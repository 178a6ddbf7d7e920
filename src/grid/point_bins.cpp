// SPDX-License-Identifier: BSD-3-Clause
// Location of the points in the grid: block and place of each, lists of the blocks, inactive blocks
// (docs/theory/mpm.md, section 8).
#include "src/grid/point_bins.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_reach.hpp"

namespace whipple::grid {

bool PointBins::bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests) {
  stencil_ = stencil;
  const bool known = slot_of_particle_.size() == position.size() || (!is_shared() && look_up(position));
  const bool complete =
      known && locate(position, stencil) && locate_guests(guests, stencil) && locate_parts(position);
  if (parallel::any(communicator(), !complete)) {
    forget_runs();
    return false;
  }
  released_.clear();
  list_particles();
  list_guests();
  list_parts();
  return true;
}

/// Finds the slot of every particle; returns false if one is outside of the active set.
bool PointBins::look_up(std::span<const Vector3> position) {
  forget_runs();
  slot_of_particle_.resize(position.size());
  std::atomic<bool> complete = true;
  parallel::for_each_chunk(position.size(), [&](std::size_t begin, std::size_t end) {
    std::int32_t slot = no_slot;
    for (std::size_t p = begin; p < end; ++p) {
      // Particles adjacent in memory are mostly in one block.
      const auto last = static_cast<std::size_t>(slot);
      if (slot == no_slot || has_two_levels() ||
          !is_inside(in_cells(position[p], last) - corner(last), edges())) {
        slot = slot_at(position[p]);
      }
      if (slot == no_slot) complete = false;
      slot_of_particle_[p] = slot;
    }
  });
  if (!complete) slot_of_particle_.clear();
  return complete;
}

/// Updates the slot of every particle from its former slot; returns false if a particle has left the active set.
/// Inactive blocks are unchanged.
bool PointBins::locate(std::span<const Vector3> position, Stencil stencil) {
  place_of_particle_.resize(position.size());
  if (!runs_known_) {
    resting_.assign(slots(), 0);
    reached_.assign(slots(), 0);
    runs_.resize(parallel::chunk_count(position.size()));
    for (std::size_t c = 0; c < runs_.size(); ++c) {
      const std::size_t begin = c * parallel::chunk_size;
      const std::size_t end = std::min(position.size(), begin + parallel::chunk_size);
      runs_[c].assign(1,
                      {.begin = static_cast<std::uint32_t>(begin), .end = static_cast<std::uint32_t>(end)});
    }
    runs_known_ = true;
  }
  for (std::size_t s = 0; s < slots(); ++s) {
    if (resting_[s] == 0) reached_[s] = 0;
  }
  const StencilPlaces places(stencil);
  std::atomic<bool> complete = true;
  // Returns whether all particles of a run reach active blocks only. The box around their stencils usually decides.
  const auto is_active = [&](const Run& run, Lanes first, Lanes last) {
    const std::uint32_t absent = ~existing(run.slot);
    const std::uint32_t touched = touched_neighbours_of_box(first, last, stencil);
    std::atomic_ref(reached_[run.slot]).fetch_or(touched, std::memory_order_relaxed);
    if ((touched & absent) == 0) return true;
    for (std::size_t p = run.begin; p < run.end; ++p) {
      const Lanes local = position_in_block(in_cells(position[p], run.slot), corner(run.slot), edges());
      if ((touched_neighbours(local, stencil) & absent) != 0) return false;
    }
    return true;
  };
  parallel::for_each_uneven(runs_.size(), [&](std::size_t c) {
    thread_local std::vector<Run> found;
    found.clear();
    Run now;  // current run
    Lanes least{}, greatest{};
    const auto finish = [&] {
      if (now.begin == now.end) return;
      if (!is_active(now, least, greatest)) complete = false;
      found.push_back(now);
      now = {};
    };
    for (const Run& before : runs_[c]) {
      if (std::atomic_ref(resting_[before.slot]).load(std::memory_order_relaxed) != 0) {
        finish();
        found.push_back(before);
        continue;
      }
      for (std::uint32_t p = before.begin; p < before.end; ++p) {
        auto slot = static_cast<std::uint32_t>(slot_of_particle_[p]);
        Lanes at = in_cells(position[p], slot);
        Lanes local = at - corner(slot);
        const bool changes_level =
            has_two_levels() && geometry().level_at(position[p]) != coordinate(slot).level;
        if (changes_level || !is_inside(local, edges())) {
          const std::int32_t moved = changes_level ? slot_at(position[p]) : slot_of_neighbour(slot, at);
          if (moved == no_slot) {
            complete = false;
            return;
          }
          slot = static_cast<std::uint32_t>(moved);
          slot_of_particle_[p] = moved;
          if (changes_level) at = in_cells(position[p], slot);
          local = position_in_block(at, corner(slot), edges());
          // A block that a particle enters becomes active.
          std::atomic_ref(resting_[slot]).store(0, std::memory_order_relaxed);
        }
        const Lanes first = places.first_node(local);
        place_of_particle_[p] = places.at(local, first);
        if (slot == now.slot && now.begin != now.end) {
          least = minimum(least, first);
          greatest = maximum(greatest, first);
        } else {
          finish();
          now.slot = slot, now.begin = p;
          least = greatest = first;
        }
        now.end = p + 1;
      }
    }
    finish();
    runs_[c].assign(found.begin(), found.end());
  });
  return complete;
}

/// Returns the slot of the block around a position in a slot's block or one of its neighbours; `no_slot` if the block
/// is inactive or farther away.
std::int32_t PointBins::slot_of_neighbour(std::size_t slot, Lanes in_cells) const {
  int neighbour = 0;
  for (int a = 0; a < 3; ++a) {
    const double block = std::floor(in_cells[a] / block_shape().along(static_cast<std::size_t>(a)));
    const double offset = block - coordinate(slot)[static_cast<std::size_t>(a)];
    if (!(std::abs(offset) <= 1.0)) return no_slot;
    neighbour = neighbour * 3 + static_cast<int>(offset) + 1;
  }
  return neighbours(slot)[static_cast<std::size_t>(neighbour)];
}

/// Looks up the blocks of the off-grid points, which may change in every step; returns false if a stencil reaches
/// beyond the active set.
bool PointBins::locate_guests(std::span<const Vector3> guests, Stencil stencil) {
  slot_of_guest_.resize(guests.size());
  place_of_guest_.resize(guests.size());
  const StencilPlaces places(stencil);
  for (std::size_t g = 0; g < guests.size(); ++g) {
    const std::int32_t slot = slot_at(guests[g]);
    if (slot == no_slot) return false;
    slot_of_guest_[g] = slot;
    const auto at = static_cast<std::size_t>(slot);
    const Lanes local = position_in_block(in_cells(guests[g], at), corner(at), edges());
    place_of_guest_[g] = places(local);
    const std::uint32_t touched = touched_neighbours(local, stencil);
    reached_[at] |= touched;
    if ((touched & ~existing(at)) != 0) return false;
  }
  return true;
}

/// Sorts whole runs by slot (counting sort); stable, so that the particles of a block keep the order of their indices.
void PointBins::list_particles() {
  PointList& list = particles_;
  list.begin.assign(slots() + 1, 0);
  for (const std::vector<Run>& runs : runs_) {
    for (const Run& run : runs) {
      if (resting_[run.slot] == 0) list.begin[run.slot + 1] += run.end - run.begin;
    }
  }
  for (const std::uint32_t p : released_) --list.begin[static_cast<std::size_t>(slot_of_particle_[p]) + 1];
  std::partial_sum(list.begin.begin(), list.begin.end(), list.begin.begin());
  list.points.resize(list.begin.back());
  next_.assign(list.begin.begin(), list.begin.end() - 1);
  auto left_out = released_.begin();
  for (std::vector<Run>& runs : runs_) {
    for (Run& run : runs) {
      run.place = next_[run.slot];
      if (resting_[run.slot] != 0) continue;
      next_[run.slot] += run.end - run.begin;
      for (; left_out != released_.end() && *left_out < run.end; ++left_out) --next_[run.slot];
    }
  }
  parallel::for_each(runs_.size(), [&](std::size_t c) {
    auto skipped = std::ranges::lower_bound(released_, runs_[c].empty() ? 0U : runs_[c].front().begin);
    for (const Run& run : runs_[c]) {
      if (resting_[run.slot] != 0) continue;
      std::uint32_t* to = list.points.data() + run.place;
      std::uint32_t p = run.begin;
      for (; skipped != released_.end() && *skipped < run.end; ++skipped, ++p) {
        for (; p < *skipped; ++p) *to++ = p;
      }
      for (; p < run.end; ++p) *to++ = p;
    }
  });
}

void PointBins::list_guests() {
  guests_.begin.assign(slots() + 1, 0);
  for (const std::int32_t slot : slot_of_guest_) ++guests_.begin[static_cast<std::size_t>(slot) + 1];
  std::partial_sum(guests_.begin.begin(), guests_.begin.end(), guests_.begin.begin());
  guests_.points.resize(slot_of_guest_.size());
  next_.assign(guests_.begin.begin(), guests_.begin.end() - 1);
  for (std::uint32_t g = 0; g < slot_of_guest_.size(); ++g) {
    guests_.points[next_[static_cast<std::size_t>(slot_of_guest_[g])]++] = g;
  }
}

void PointBins::list_by_stencil(std::vector<std::uint32_t>& order) const {
  order.resize(particles_.points.size());
  parallel::for_each_uneven(slots(), [&](std::size_t slot) {  // counting sort
    const std::span<const std::uint32_t> members = particles_in(slot);
    if (members.empty()) return;
    std::array<std::uint32_t, Stencil{}.nodes_reached() + 1> next{};
    const auto first_node = [&](std::uint32_t p) {
      return static_cast<std::size_t>(place_of_particle_[p].first_node());
    };
    for (const std::uint32_t p : members) ++next[first_node(p) + 1];
    next[0] = particles_.begin[slot];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const std::uint32_t p : members) order[next[first_node(p)]++] = p;
  });
}

void PointBins::particles_reordered() {
  forget_runs();
  slot_of_particle_.clear();
}

void PointBins::particles_reordered(std::span<const std::uint32_t> order) {
  if (is_shared()) return particles_reordered();
  forget_runs();
  reordered_.resize(order.size());
  parallel::for_each(order.size(), [&](std::size_t i) { reordered_[i] = slot_of_particle_[order[i]]; });
  slot_of_particle_.swap(reordered_);
}

void PointBins::particles_removed(std::span<const Move> moves, std::size_t size) {
  forget_runs();
  if (!slot_of_particle_.empty()) close_gaps(slot_of_particle_, moves, size);
}

void PointBins::forget_runs() {
  runs_known_ = false;
  ++arrangement_;
}

void PointBins::release(std::span<const std::uint32_t> particles) {
  if (particles.empty()) return;
  released_.assign(particles.begin(), particles.end());
  for (const std::uint32_t p : particles) resting_[static_cast<std::size_t>(slot_of_particle_[p])] = 0;
  list_particles();
  list_parts();
}

std::size_t PointBins::let_rest_beyond(int layers, std::vector<std::uint64_t> awake) {
  const auto for_each_reached = [&](std::size_t s, auto&& f) {
    for_each_bit(reached_[s], [&](unsigned n) {
      if (neighbours(s)[n] != no_slot) f(static_cast<std::size_t>(neighbours(s)[n]));
    });
  };
  for (const std::uint32_t p : released_) awake[static_cast<std::size_t>(slot_of_particle_[p])] = 1;
  join_bits_of_ranks(awake);
  wake_both_levels(awake);
  for (int layer = 0; layer < layers; ++layer) {  // blocks that share nodes with active blocks become active
    std::vector<std::uint64_t> stirred(slots(), 0);
    parallel::for_each(slots(), [&](std::size_t s) {
      if (awake[s] == 0) return;
      for_each_reached(s, [&](std::size_t reached) {
        std::atomic_ref(stirred[reached]).store(1, std::memory_order_relaxed);
      });
    });
    join_bits_of_ranks(stirred);
    parallel::for_each(slots(), [&](std::size_t s) {
      if (awake[s] != 0) return;
      for_each_reached(s, [&](std::size_t reached) { awake[s] |= stirred[reached]; });
    });
    wake_both_levels(awake);
  }
  bool changed = false;
  for (std::size_t s = 0; s < slots(); ++s) {
    const std::uint8_t rests = awake[s] == 0 ? 1 : 0;
    changed |= rests != resting_[s];
    resting_[s] = rests;
  }
  if (changed) {
    list_particles();
    list_parts();
  }
  return slot_of_particle_.size() - released_.size() - particles_.points.size();
}

void PointBins::wake() {
  if (std::ranges::find(resting_, 1) == resting_.end()) return;
  std::ranges::fill(resting_, std::uint8_t{0});
  list_particles();
  list_parts();
}

bool PointBins::chunk_rests(std::size_t chunk) const {
  return runs_known_ &&
         std::ranges::all_of(runs_[chunk], [&](const Run& run) { return resting_[run.slot] != 0; });
}

void PointBins::count_cells(std::span<const Vector3> position, std::span<const Vector3> guests) {
  cell_count_.assign(slots() * nodes_per_block, 0);
  const auto count = [&](std::size_t slot, const Vector3& point) {
    const std::array<int, 3> cell = floor_of_three(in_cells(point, slot) - corner(slot));
    ++cell_count_[slot * nodes_per_block +
                  static_cast<std::size_t>(block_shape().node(cell[0], cell[1], cell[2]))];
  };
  for (std::size_t p = 0; p < position.size(); ++p) {
    count(static_cast<std::size_t>(slot_of_particle_[p]), position[p]);
  }
  for (std::size_t g = 0; g < guests.size(); ++g) {
    count(static_cast<std::size_t>(slot_of_guest_[g]), guests[g]);
  }
  // Other ranks may have particles, unknown here, in their ghost blocks and in their own blocks.
  unshared_.assign(slots(), 1);
  for (std::size_t s = owned_slots(); s < slots(); ++s) unshared_[s] = 0;
  for (const BlockSet::Peer& peer : peers()) {
    for (const std::uint32_t s : peer.lent) unshared_[s] = 0;
  }
}

bool PointBins::is_alone(std::uint32_t particle, const Vector3& position) const {
  constexpr int ring = 2;
  const auto slot = static_cast<std::size_t>(slot_of_particle_[particle]);
  const Geometry& geometry = this->geometry(slot);
  const Lanes place = geometry.in_cells(position);
  for (std::size_t face = 0; face < 6; ++face) {
    if (geometry.boundary[face] == Boundary::outflow) continue;
    const std::size_t axis = face / 2;
    const double depth = face % 2 == 0 ? place[axis] : geometry.cells[axis] - place[axis];
    if (depth < ring) return false;
  }
  if (has_two_levels()) {  // cells of the other level count their own points
    const Lanes fine = this->geometry().in_cells(position), around = broadcast(2.0 * ring + 1.0);
    const Level other = coordinate(slot).level == Level::fine ? Level::coarse : Level::fine;
    if (geometry.levels.may_need(other, fine, around)) return false;
  }
  const std::array<int, 3> cell = floor_of_three(place - corner(slot));
  const int ring_z = geometry.is_planar() ? 0 : ring;
  const auto place_along = [&](int c, std::size_t axis) {  // block (0 to 2) and cell in it
    const int edge = block_shape().along(axis);
    return std::pair{c < 0 ? 0 : c < edge ? 1 : 2, (c + edge) % edge};
  };
  int count = 0;
  for (int i = cell[0] - ring; i <= cell[0] + ring; ++i) {
    const auto [block_x, x] = place_along(i, 0);
    for (int j = cell[1] - ring; j <= cell[1] + ring; ++j) {
      const auto [block_y, y] = place_along(j, 1);
      for (int k = cell[2] - ring_z; k <= cell[2] + ring_z; ++k) {
        const auto [block_z, z] = place_along(k, 2);
        const std::int32_t owner =
            neighbours(slot)[static_cast<std::size_t>(neighbour_index(block_x, block_y, block_z))];
        if (owner == no_slot) {
          if (is_shared()) return false;
          continue;
        }
        const auto of = static_cast<std::size_t>(owner);
        if (unshared_[of] == 0) return false;
        count += cell_count_[of * nodes_per_block + static_cast<std::size_t>(block_shape().node(x, y, z))];
        if (count > 1) return false;
      }
    }
  }
  return true;
}

}  // namespace whipple::grid
