// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/block_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "src/base/error.hpp"
#include "src/base/vector_math.hpp"
#include "src/grid/block_reach.hpp"
#include "src/parallel/mpi.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::grid {
namespace {

BlockCoordinate shifted(const BlockCoordinate& block, int neighbour) {
  return {block[0] + neighbour / 9 - 1, block[1] + neighbour / 3 % 3 - 1, block[2] + neighbour % 3 - 1};
}

/// Is a position, in cells from the lower corner of a block, inside of it?
bool is_inside(Lanes local) { return bits((local >= 0.0) & (local < double{block_edge})) == all_lanes; }

}  // namespace

BlockGrid::BlockGrid(const Geometry& geometry, MPI_Comm communicator)
    : communicator_(communicator),
      geometry_(geometry),
      origin_(geometry.lower),
      forest_(geometry, communicator) {
  for (int face = 0; face < 6; ++face) {
    const Boundary boundary = geometry.boundary[static_cast<std::size_t>(face)];
    if (boundary == Boundary::outflow) continue;
    planes_.push_back(
        {.face = face, .axis = face / 2, .kind = boundary, .pairs = {}, .on_plane = {}, .near = {}});
  }
  std::ranges::stable_sort(planes_, {},
                           [](const MirrorPlane& plane) { return plane.kind == Boundary::separating; });
}

std::optional<BlockCoordinate> BlockGrid::block_of(const Vector3& position) const {
  BlockCoordinate block{};
  const Lanes at = in_cells(position);
  for (std::size_t a = 0; a < 3; ++a) {
    const double cells = at[a];
    if (!(cells > -1.0 && cells < geometry_.cells[a] + 1.0)) return std::nullopt;
    block[a] = static_cast<std::int32_t>(std::floor(cells / block_edge));
  }
  return block;
}

bool BlockGrid::bin(std::span<const Vector3> position, Stencil stencil, std::span<const Vector3> guests) {
  const bool known = slot_of_particle_.size() == position.size() || (!is_shared() && look_up(position));
  const bool complete = known && locate(position, stencil) && locate_guests(guests, stencil);
  if (parallel::any(communicator_, !complete)) return false;
  released_.clear();
  resting_.clear();
  list_points();
  return true;
}

/// Finds the slot of every particle; false if one is outside of the active set.
bool BlockGrid::look_up(std::span<const Vector3> position) {
  slot_of_particle_.resize(position.size());
  std::int32_t slot = no_slot;
  for (std::size_t p = 0; p < position.size(); ++p) {
    // Neighbours in memory are mostly in one block.
    if (slot == no_slot || !is_inside(in_cells(position[p]) - corner_[static_cast<std::size_t>(slot)])) {
      slot = slot_at(position[p]);
    }
    if (slot == no_slot) {
      slot_of_particle_.clear();
      return false;
    }
    slot_of_particle_[p] = slot;
  }
  return true;
}

/// Updates the slot of every particle from its former slot; false if a particle left the active set.
bool BlockGrid::locate(std::span<const Vector3> position, Stencil stencil) {
  place_of_particle_.resize(position.size());
  reached_.assign(slots(), 0);
  const StencilPlaces places(stencil);
  std::atomic<bool> complete = true;
  // Do all particles of a run, which are in one slot, reach active blocks only? The box around their stencils
  // mostly tells.
  const auto is_active = [&](std::size_t slot, std::size_t begin, std::size_t end, Lanes first, Lanes last) {
    if (begin == end) return true;
    const std::uint32_t absent = ~existing_[slot], touched = touched_neighbours_of_box(first, last, stencil);
    std::atomic_ref(reached_[slot]).fetch_or(touched, std::memory_order_relaxed);
    if ((touched & absent) == 0) return true;
    for (std::size_t p = begin; p < end; ++p) {
      const Lanes local = position_in_block(in_cells(position[p]), corner_[slot]);
      if ((touched_neighbours(local, stencil) & absent) != 0) return false;
    }
    return true;
  };
  parallel::for_each_chunk(position.size(), [&](std::size_t begin, std::size_t end) {
    std::size_t run_slot = static_cast<std::size_t>(slot_of_particle_[begin]), run_begin = begin;
    Lanes least = broadcast(block_edge), greatest = broadcast(-1.0);
    for (std::size_t p = begin; p < end; ++p) {
      auto slot = static_cast<std::size_t>(slot_of_particle_[p]);
      const Lanes at = in_cells(position[p]);
      Lanes local = at - corner_[slot];
      if (!is_inside(local)) {
        const std::int32_t moved = slot_of_neighbour(slot, at);
        if (moved == no_slot) {
          complete = false;
          return;
        }
        slot = static_cast<std::size_t>(moved);
        slot_of_particle_[p] = moved;
        local = position_in_block(at, corner_[slot]);
      }
      const Lanes first = places.first_node(local);
      place_of_particle_[p] = places.at(local, first);
      if (slot != run_slot) {
        if (!is_active(run_slot, run_begin, p, least, greatest)) complete = false;
        run_slot = slot, run_begin = p;
        least = greatest = first;
      } else {
        least = minimum(least, first);
        greatest = maximum(greatest, first);
      }
    }
    if (!is_active(run_slot, run_begin, end, least, greatest)) complete = false;
  });
  return complete;
}

/// Slot of the block around a position in a slot's block or one of its neighbours; `no_slot` if that is not
/// active or farther away.
std::int32_t BlockGrid::slot_of_neighbour(std::size_t slot, Lanes in_cells) const {
  int neighbour = 0;
  for (int a = 0; a < 3; ++a) {
    const double block = std::floor(in_cells[a] / block_edge);
    const double offset = block - blocks_.coordinate[slot][static_cast<std::size_t>(a)];
    if (!(std::abs(offset) <= 1.0)) return no_slot;
    neighbour = neighbour * 3 + static_cast<int>(offset) + 1;
  }
  return neighbours_[slot][static_cast<std::size_t>(neighbour)];
}

/// Guests come and go, so each one's block is looked up; false if a stencil reaches beyond the active set.
bool BlockGrid::locate_guests(std::span<const Vector3> guests, Stencil stencil) {
  slot_of_guest_.resize(guests.size());
  place_of_guest_.resize(guests.size());
  const StencilPlaces places(stencil);
  for (std::size_t g = 0; g < guests.size(); ++g) {
    const std::int32_t slot = slot_at(guests[g]);
    if (slot == no_slot) return false;
    slot_of_guest_[g] = slot;
    const auto at = static_cast<std::size_t>(slot);
    const Lanes local = position_in_block(in_cells(guests[g]), corner_[at]);
    place_of_guest_[g] = places(local);
    const std::uint32_t touched = touched_neighbours(local, stencil);
    reached_[at] |= touched;
    if ((touched & ~existing_[at]) != 0) return false;
  }
  return true;
}

std::vector<WantedBlock> BlockGrid::wanted_blocks(std::span<const Vector3> position,
                                                  std::span<const Vector3> velocity, double lookahead,
                                                  Stencil stencil, const Work& work) const {
  // Blocks with particles, and for each the neighbours that its particles reach now and within the
  // look-ahead.
  BlockTable homes;
  homes.reserve(slots() + 64);
  std::vector<WantedBlock> home;
  std::vector<Lanes> corner;  // of the homes
  std::vector<std::uint32_t> wanted_mask;
  std::size_t i = 0;  // home of the particle before
  std::string error;
  for (std::size_t p = 0; p < position.size(); ++p) {
    const Lanes at = in_cells(position[p]);
    const bool on_grid = p + work.apart < position.size();
    // Neighbours in memory are mostly in one block.
    if (home.empty() || !is_inside(at - corner[i])) {
      const std::optional<BlockCoordinate> block = block_of(position[p]);
      if (!block) {
        error = fmt::format("particle with index {} is outside of the domain: position ({}, {}, {}) m", p,
                            position[p][0], position[p][1], position[p][2]);
        break;
      }
      i = static_cast<std::size_t>(homes.find_or_insert(*block, static_cast<std::int32_t>(home.size())));
      if (i == home.size()) {
        home.push_back({*block, on_grid ? work.of_block : 0.0});
        corner.push_back(corner_of(*block));
        wanted_mask.push_back(1U << neighbour_index(1, 1, 1));
      }
    }
    home[i].weight += p < work.of_particle.size() ? work.of_particle[p] : 1.0;
    if (!on_grid) continue;
    const Lanes motion = load_vector(velocity[p].data()) * (lookahead / geometry_.cell_size);
    const Lanes ahead = maximum(minimum(motion, broadcast(2.0)), broadcast(-2.0));
    wanted_mask[i] |= touched_neighbours(at - corner[i], ahead, stencil, foresight_);
  }
  parallel::throw_together(communicator_, error);

  BlockTable wanted_table;
  wanted_table.reserve(2 * home.size());
  std::vector<WantedBlock> wanted;
  for (i = 0; i < home.size(); ++i) {
    for (int n = 0; n < 27; ++n) {
      if ((wanted_mask[i] >> n & 1U) == 0) continue;
      const BlockCoordinate block = shifted(home[i].coordinate, n);
      bool inside = true;  // motion may foresee blocks beyond the outer layer
      for (std::size_t a = 0; a < 3; ++a) {
        inside = inside && block[a] >= -1 && block[a] <= geometry_.blocks(static_cast<int>(a));
      }
      if (!inside) continue;
      const auto next = static_cast<std::int32_t>(wanted.size());
      const std::int32_t at = wanted_table.find_or_insert(block, next);
      if (at == next) wanted.push_back({block, 0.0});
      if (n == neighbour_index(1, 1, 1)) wanted[static_cast<std::size_t>(at)].weight = home[i].weight;
    }
  }
  return wanted;
}

void BlockGrid::adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                      Stencil stencil, const Work& work) {
  ++adaptations_;
  wanted_ = wanted_blocks(position, velocity, lookahead, stencil, work);
  forest_.adapt(wanted_);
}

std::vector<int> BlockGrid::owners(std::span<const Vector3> position) const {
  std::vector<int> owner(position.size(), 0);
  if (parallel::size(communicator_) == 1) return owner;
  BlockTable known;
  known.reserve(slots() + 64);
  for (std::size_t p = 0; p < position.size(); ++p) {
    const std::optional<BlockCoordinate> block = block_of(position[p]);
    if (!block) throw InternalError("the owner of a particle outside of the domain was asked for");
    std::int32_t& rank = known.find_or_insert(*block, BlockTable::none);
    if (rank == BlockTable::none) rank = forest_.owner(*block);
    owner[p] = rank;
  }
  return owner;
}

void BlockGrid::owners_reached(const Vector3& position, Stencil stencil, std::vector<int>& ranks) const {
  const std::optional<BlockCoordinate> block = block_of(position);
  if (!block) return;
  for_each_bit(touched_neighbours(in_cells(position) - corner_of(*block), stencil), [&](unsigned n) {
    const BlockCoordinate reached = shifted(*block, static_cast<int>(n));
    for (std::size_t a = 0; a < 3; ++a) {
      if (reached[a] < -1 || reached[a] > geometry_.blocks(static_cast<int>(a))) return;
    }
    const int rank = forest_.owner(reached);
    if (std::ranges::find(ranks, rank) == ranks.end()) ranks.push_back(rank);
  });
}

void BlockGrid::activate(std::span<const Vector3> position, std::span<const Vector3> velocity,
                         double lookahead, Stencil stencil, std::size_t guests) {
  // Particles may have come and gone since `adapt`, unless there is no other rank.
  if (parallel::size(communicator_) > 1) {
    wanted_ = wanted_blocks(position, velocity, lookahead, stencil, {});
  }
  blocks_ = forest_.claim(wanted_);
  table_.reserve(slots());
  for (std::size_t s = 0; s < slots(); ++s) {
    table_.find_or_insert(blocks_.coordinate[s], static_cast<std::int32_t>(s));
  }
  neighbours_.resize(slots());
  for (auto& of_slot : neighbours_) of_slot.fill(no_slot);
  existing_.assign(slots(), 0);
  corner_.assign(slots(), Lanes{});
  parallel::for_each(slots(), [&](std::size_t s) {
    const BlockCoordinate& block = blocks_.coordinate[s];
    corner_[s] = corner_of(block);
    // Of two neighbours the first finds the second, and leaves itself with it.
    for (std::size_t n = 0; n < 27; ++n) {
      if (n == 13) {
        neighbours_[s][n] = static_cast<std::int32_t>(s);
      } else if (n < 13) {
        const std::int32_t slot = table_.find(shifted(block, static_cast<int>(n)));
        neighbours_[s][n] = slot;
        if (slot != no_slot)
          neighbours_[static_cast<std::size_t>(slot)][26 - n] = static_cast<std::int32_t>(s);
      }
    }
  });
  parallel::for_each(slots(), [&](std::size_t s) {
    for (std::size_t n = 0; n < 27; ++n) {
      if (neighbours_[s][n] != no_slot) existing_[s] |= 1U << n;
    }
  });
  fields_.clear();
  lay_out_nodes();
  find_border();
  set_apart();
  look_up(position.first(position.size() - guests));
}

void BlockGrid::particles_reordered(std::span<const std::uint32_t> order) {
  if (is_shared()) return particles_reordered();
  reordered_.resize(order.size());
  parallel::for_each(order.size(), [&](std::size_t i) { reordered_[i] = slot_of_particle_[order[i]]; });
  slot_of_particle_.swap(reordered_);
}

void BlockGrid::particles_removed(std::span<const Move> moves, std::size_t size) {
  if (!slot_of_particle_.empty()) close_gaps(slot_of_particle_, moves, size);
}

void BlockGrid::shift(const Vector3& cells) {
  geometry_.lower = origin_ + geometry_.cell_size * cells;
  foresight_ = 1.0;  // from half a cell on one side to half a cell on the other
}

void BlockGrid::count_cells(std::span<const Vector3> position, std::span<const Vector3> guests) {
  cell_count_.assign(slots() * nodes_per_block, 0);
  const auto count = [&](std::size_t slot, const Vector3& point) {
    const std::array<int, 3> cell = floor_of_three(in_cells(point) - corner_[slot]);
    ++cell_count_[slot * nodes_per_block + static_cast<std::size_t>(node_index(cell[0], cell[1], cell[2]))];
  };
  for (std::size_t s = 0; s < slots(); ++s) {
    for (const std::uint32_t p : particles_in(s)) count(s, position[p]);
    for (const std::uint32_t g : guests_in(s)) count(s, guests[g]);
  }
  // Other ranks may have particles, unseen here, in blocks that they borrow and in blocks of their own.
  unshared_.assign(slots(), 1);
  for (std::size_t s = blocks_.owned; s < slots(); ++s) unshared_[s] = 0;
  for (const BlockSet::Peer& peer : blocks_.peers) {
    for (const std::uint32_t s : peer.lent) unshared_[s] = 0;
  }
}

bool BlockGrid::is_alone(std::uint32_t particle, const Vector3& position) const {
  constexpr int ring = 2;
  const Lanes place = in_cells(position);
  for (const MirrorPlane& plane : planes_) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    const double depth = plane.face % 2 == 0 ? place[axis] : geometry_.cells[axis] - place[axis];
    if (depth < ring) return false;
  }
  const auto slot = static_cast<std::size_t>(slot_of_particle_[particle]);
  const std::array<int, 3> cell = floor_of_three(place - corner_[slot]);
  int count = 0;
  for (int x = cell[0] - ring; x <= cell[0] + ring; ++x) {
    for (int y = cell[1] - ring; y <= cell[1] + ring; ++y) {
      for (int z = cell[2] - ring; z <= cell[2] + ring; ++z) {
        const auto block = [](int c) { return c < 0 ? 0 : c < block_edge ? 1 : 2; };
        const std::int32_t owner =
            neighbours_[slot][static_cast<std::size_t>(neighbour_index(block(x), block(y), block(z)))];
        if (owner == no_slot) {
          if (is_shared()) return false;
          continue;
        }
        const auto of = static_cast<std::size_t>(owner);
        if (unshared_[of] == 0) return false;
        const auto inside = [](int c) { return (c + block_edge) % block_edge; };
        count += cell_count_[of * nodes_per_block +
                             static_cast<std::size_t>(node_index(inside(x), inside(y), inside(z)))];
        if (count > 1) return false;
      }
    }
  }
  return true;
}

void BlockGrid::release(std::span<const std::uint32_t> particles) {
  if (particles.empty()) return;
  released_.assign(slot_of_particle_.size(), 0);
  for (const std::uint32_t p : particles) released_[p] = 1;
  list_points();
}

namespace {

/// Calls f(slot, begin, end) for the runs of points with one slot.
template <class Function>
void for_each_run(std::span<const std::int32_t> slot_of, Function&& f) {
  for (std::size_t begin = 0, end = 0; begin < slot_of.size(); begin = end) {
    const std::int32_t slot = slot_of[begin];
    end = begin + 1;
    const auto eight_more = [&] {
      bool same = true;
      for (std::size_t i = 0; i < 8; ++i) same &= slot_of[end + i] == slot;
      return same;
    };
    while (end + 8 <= slot_of.size() && eight_more()) end += 8;
    while (end < slot_of.size() && slot_of[end] == slot) ++end;
    f(static_cast<std::size_t>(slot), begin, end);
  }
}

/// Counting sort by slot; stable, so that the points of a block keep the order of their indices. The points
/// are nearly sorted, so whole runs go at a time.
/// @param released  of each point; or empty: none
/// @param resting   of each slot; or empty: none
void list_by_slot(std::size_t slots, std::span<const std::int32_t> slot_of,
                  std::span<const std::uint8_t> released, std::span<const std::uint8_t> resting,
                  PointList& list) {
  list.begin.assign(slots + 1, 0);
  const auto rests = [&](std::size_t slot) { return !resting.empty() && resting[slot] != 0; };
  for_each_run(slot_of, [&](std::size_t slot, std::size_t begin, std::size_t end) {
    if (rests(slot)) return;
    std::size_t count = end - begin;
    if (!released.empty()) {
      for (std::size_t p = begin; p < end; ++p) count -= released[p];
    }
    list.begin[slot + 1] += static_cast<std::uint32_t>(count);
  });
  for (std::size_t s = 0; s < slots; ++s) list.begin[s + 1] += list.begin[s];
  list.points.resize(list.begin.back());
  std::vector<std::uint32_t> next(list.begin.begin(), list.begin.end() - 1);
  for_each_run(slot_of, [&](std::size_t slot, std::size_t begin, std::size_t end) {
    if (rests(slot)) return;
    std::uint32_t* to = &list.points[0] + next[slot];
    for (std::size_t p = begin; p < end; ++p) {
      if (released.empty() || released[p] == 0) *to++ = static_cast<std::uint32_t>(p);
    }
    next[slot] = static_cast<std::uint32_t>(to - &list.points[0]);
  });
}

}  // namespace

void BlockGrid::list_points() {
  list_by_slot(slots(), slot_of_particle_, released_, resting_, particles_);
  list_by_slot(slots(), slot_of_guest_, {}, {}, guests_);
}

std::size_t BlockGrid::let_rest(int layers, const std::function<bool(std::size_t)>& is_restless) {
  const auto for_each_reached = [&](std::size_t s, auto&& f) {
    for_each_bit(reached_[s], [&](unsigned n) {
      if (neighbours_[s][n] != no_slot) f(static_cast<std::size_t>(neighbours_[s][n]));
    });
  };
  std::vector<std::uint64_t> awake(slots(), 0);
  parallel::for_each_uneven(
      slots(), [&](std::size_t s) { awake[s] = !guests_in(s).empty() || is_restless(s) ? 1 : 0; });
  join_bits_of_ranks(awake);
  for (int layer = 0; layer < layers; ++layer) {  // what shares nodes with what is awake awakes
    std::vector<std::uint64_t> stirred(slots(), 0);
    for (std::size_t s = 0; s < slots(); ++s) {
      if (awake[s] != 0) for_each_reached(s, [&](std::size_t reached) { stirred[reached] = 1; });
    }
    join_bits_of_ranks(stirred);
    for (std::size_t s = 0; s < slots(); ++s) {
      if (awake[s] != 0) continue;
      bool stirs = false;
      for_each_reached(s, [&](std::size_t reached) { stirs |= stirred[reached] != 0; });
      if (stirs) awake[s] = 1;
    }
  }
  resting_.resize(slots());
  std::size_t at_rest = 0;
  for (std::size_t s = 0; s < slots(); ++s) {
    resting_[s] = awake[s] == 0 ? 1 : 0;
    if (resting_[s] != 0) at_rest += particles_in(s).size();
  }
  if (at_rest > 0) list_points();
  return at_rest;
}

void BlockGrid::list_by_stencil(std::vector<std::uint32_t>& order) const {
  order.resize(particles_.points.size());
  parallel::for_each_uneven(slots(), [&](std::size_t slot) {  // counting sort
    const std::span<const std::uint32_t> members = particles_in(slot);
    if (members.empty()) return;
    std::array<std::uint32_t, reach_edge * reach_edge * reach_edge + 1> next{};
    const auto first_node = [&](std::uint32_t p) {
      return static_cast<std::size_t>(place_of_particle_[p].first_node());
    };
    for (const std::uint32_t p : members) ++next[first_node(p) + 1];
    next[0] = particles_.begin[slot];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const std::uint32_t p : members) order[next[first_node(p)]++] = p;
  });
}

void BlockGrid::set_apart() {
  const int halved = slots() >= slots_for_cubes ? 1 : 0;
  const auto group_of = [&](std::uint32_t slot) {
    const BlockCoordinate& c = blocks_.coordinate[slot];
    return BlockCoordinate{(c[0] + 1) >> halved, (c[1] + 1) >> halved, (c[2] + 1) >> halved};
  };
  apart_ = {};
  BlockTable group_number;  // of each region and colour
  std::array<std::array<std::vector<std::pair<std::uint32_t, std::uint32_t>>, 8>, 2> members;
  group_number.reserve(slots());
  std::int32_t groups = 0;
  for (std::uint32_t s = 0; s < slots(); ++s) {
    const BlockCoordinate c = group_of(s);
    std::int32_t& number = group_number.find_or_insert(c, groups);
    if (number == groups) ++groups;
    members[static_cast<std::size_t>(region(s))]
           [static_cast<std::size_t>((c[0] & 1) << 2 | (c[1] & 1) << 1 | (c[2] & 1))]
               .emplace_back(static_cast<std::uint32_t>(number), s);
  }
  for (std::size_t r = 0; r < members.size(); ++r) {
    for (std::size_t colour = 0; colour < 8; ++colour) {
      auto& list = members[r][colour];
      std::ranges::sort(list);
      SlotGroups& of_colour = apart_[r][colour];
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (i == 0 || list[i].first != list[i - 1].first) {
          of_colour.begin.push_back(static_cast<std::uint32_t>(i));
        }
        of_colour.slots.push_back(list[i].second);
      }
      of_colour.begin.push_back(static_cast<std::uint32_t>(list.size()));
    }
  }
}

void BlockGrid::clear() {
  parallel::for_each(nodes_.size() / nodes_per_block, [&](std::size_t b) {
    Node* of_block = &nodes_[b * nodes_per_block];
    for (int i = 0; i < nodes_per_block; ++i) of_block[i] = {broadcast(0.0), broadcast(0.0)};
  });
}

std::size_t BlockGrid::bytes() const {
  return nodes_.size() * sizeof(Node) + slots() * (sizeof(neighbours_[0]) + sizeof(BlockCoordinate)) +
         slot_of_particle_.size() * 8 +
         (place_of_particle_.size() + place_of_guest_.size()) * sizeof(PlaceInStencil);
}

}  // namespace whipple::grid
