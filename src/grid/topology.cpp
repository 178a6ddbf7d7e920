// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_reach.hpp"
#include "src/grid/slot_messages.hpp"

namespace whipple::grid {
namespace {

BlockCoordinate shifted(const BlockCoordinate& block, int neighbour) {
  return {{block[0] + neighbour / 9 - 1, block[1] + neighbour / 3 % 3 - 1, block[2] + neighbour % 3 - 1},
          block.level};
}

/// Joins the blocks of the levels: the owned ones of all, then the ghosts.
BlockSet joined(const std::vector<BlockSet>& of_level) {
  if (of_level.size() == 1) return of_level.front();
  BlockSet all;
  for (const BlockSet& set : of_level) all.owned += set.owned;
  std::map<int, BlockSet::Peer> peers;
  std::size_t owned = 0, ghosts = all.owned;
  for (const BlockSet& set : of_level) {
    const auto slot = [&](std::uint32_t of) {
      return static_cast<std::uint32_t>(of < set.owned ? owned + of : ghosts + (of - set.owned));
    };
    for (const BlockSet::Peer& peer : set.peers) {
      BlockSet::Peer& of_rank = peers[peer.rank];
      of_rank.rank = peer.rank;
      std::ranges::transform(peer.lent, std::back_inserter(of_rank.lent), slot);
      std::ranges::transform(peer.borrowed, std::back_inserter(of_rank.borrowed), slot);
    }
    owned += set.owned;
    ghosts += set.coordinate.size() - set.owned;
  }
  for (const bool are_owned : {true, false}) {
    for (const BlockSet& set : of_level) {
      const auto first = set.coordinate.begin() + static_cast<std::ptrdiff_t>(are_owned ? 0 : set.owned);
      const auto last =
          are_owned ? set.coordinate.begin() + static_cast<std::ptrdiff_t>(set.owned) : set.coordinate.end();
      all.coordinate.insert(all.coordinate.end(), first, last);
    }
  }
  for (auto& [rank, peer] : peers) all.peers.push_back(std::move(peer));
  return all;
}

}  // namespace

Topology::Topology(const Geometry& geometry, MPI_Comm communicator)
    : communicator_(communicator), origin_(geometry.lower), block_(geometry.block()), edges_(block_.edges()) {
  for (const Level level : {Level::fine, Level::coarse}) {
    if (level == Level::coarse && !geometry.levels.are_two()) continue;
    geometries_.push_back(geometry.of_level(level));
    forests_.emplace_back(geometries_.back(), communicator);
  }
}

bool Topology::is_shared() const { return parallel::size(communicator_) > 1; }

std::size_t Topology::forest_leaves() const {
  return std::accumulate(forests_.begin(), forests_.end(), std::size_t{0},
                         [](std::size_t sum, const Forest& forest) { return sum + forest.leaves(); });
}

std::optional<BlockCoordinate> Topology::block_of(const Vector3& position, Level level) const {
  BlockCoordinate block{{}, level};
  const Geometry& geometry = this->geometry(block);
  const Lanes at = geometry.in_cells(position);
  for (std::size_t a = 0; a < 3; ++a) {
    const double cells = at[a];
    if (!(cells > -1.0 && cells < geometry.cells[a] + 1.0)) return std::nullopt;
    block[a] = static_cast<std::int32_t>(std::floor(cells / block_.along(a)));
  }
  return block;
}

/// Returns whether a block is in the domain or its outer layer.
bool Topology::contains(const BlockCoordinate& block) const {
  for (std::size_t a = 0; a < 3; ++a) {
    if (block[a] < -1 || block[a] > geometry(block).blocks(static_cast<int>(a))) return false;
  }
  return true;
}

/// Returns the blocks of a level with particles that have, or may soon have, its functions, and for each the neighbours
/// that its particles reach now and within the look-ahead. Collective.
std::vector<Topology::Home> Topology::homes(Level level, std::span<const Vector3> position,
                                            std::span<const Vector3> velocity, double lookahead,
                                            Stencil stencil, const Work& work) const {
  const Geometry& geometry = geometries_[number(level)];
  const Levels& levels = geometry.levels;
  // First collected for consecutive particles in one block.
  std::vector<std::vector<Home>> homes_of(parallel::chunk_count(position.size()));
  std::atomic<bool> outside = false;
  parallel::for_each_chunk(position.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Home>& homes = homes_of[begin / parallel::chunk_size];
    Lanes corner{};  // of the last home
    for (std::size_t p = begin; p < end; ++p) {
      const Lanes at = geometry.in_cells(position[p]);
      const bool on_grid = p + work.apart < position.size();
      const Lanes motion =
          on_grid ? load_vector(velocity[p].data()) * (lookahead / geometry.cell_size) : Lanes{};
      const Lanes ahead = maximum(minimum(motion, broadcast(2.0)), broadcast(-2.0));
      bool is_own = true;
      if (levels.are_two()) {
        const double fine = level == Level::fine ? 1.0 : 2.0;
        const Lanes around = fine * (maximum(ahead, -ahead) + broadcast(foresight_));
        is_own = levels.level_at(fine * at) == level;
        if (!is_own && !(on_grid && levels.may_need(level, fine * at, around))) continue;
      }
      if (homes.empty() || !is_inside(at - corner, edges_)) {
        const std::optional<BlockCoordinate> block = block_of(position[p], level);
        if (!block) {
          outside = true;
          return;
        }
        homes.push_back({{*block, 0.0}, 0});
        corner = corner_of(*block, block_);
      }
      Home& home = homes.back();
      if (is_own) home.block.weight += p < work.of_particle.size() ? work.of_particle[p] : 1.0;
      if (on_grid) home.wanted |= touched_neighbours(at - corner, ahead, stencil, foresight_);
    }
  });
  std::string error;
  if (outside) {
    const auto p = std::ranges::find_if(position, [&](const Vector3& x) { return !block_of(x); });
    error = fmt::format("particle with index {} is outside of the domain: position ({}, {}, {}) m",
                        p - position.begin(), (*p)[0], (*p)[1], (*p)[2]);
  }
  parallel::throw_together(communicator_, error);

  BlockTable table;
  table.reserve(slots() + 64);
  std::vector<Home> home;
  for (const std::vector<Home>& of_chunk : homes_of) {
    for (const Home& part : of_chunk) {
      const auto next = static_cast<std::int32_t>(home.size());
      const std::int32_t i = table.find_or_insert(part.block.coordinate, next);
      if (i == next) {
        home.push_back(part);
      } else {
        home[static_cast<std::size_t>(i)].block.weight += part.block.weight;
        home[static_cast<std::size_t>(i)].wanted |= part.wanted;
      }
    }
  }
  for (Home& of_block : home) {
    if (of_block.wanted != 0) of_block.block.weight += work.of_block;
    of_block.wanted |= 1U << neighbour_index(1, 1, 1);
  }
  return home;
}

std::vector<WantedBlock> Topology::wanted_blocks(Level level, std::span<const Vector3> position,
                                                 std::span<const Vector3> velocity, double lookahead,
                                                 Stencil stencil, const Work& work) const {
  const std::vector<Home> home = homes(level, position, velocity, lookahead, stencil, work);
  BlockTable wanted_table;
  wanted_table.reserve(2 * home.size());
  std::vector<WantedBlock> wanted;
  for (const Home& of_block : home) {
    for (int n = 0; n < 27; ++n) {
      if ((of_block.wanted >> n & 1U) == 0) continue;
      const BlockCoordinate block = shifted(of_block.block.coordinate, n);
      if (!contains(block)) continue;  // the motion may lead beyond the outer layer
      const auto next = static_cast<std::int32_t>(wanted.size());
      const std::int32_t at = wanted_table.find_or_insert(block, next);
      if (at == next) wanted.push_back({block, 0.0});
      if (n == neighbour_index(1, 1, 1)) wanted[static_cast<std::size_t>(at)].weight = of_block.block.weight;
    }
  }
  if (is_shared()) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {  // the list grows in the loop
      for_each_mirror_block(wanted[i].coordinate, [&](const BlockCoordinate& mirror) {
        const auto next = static_cast<std::int32_t>(wanted.size());
        if (wanted_table.find_or_insert(mirror, next) == next) wanted.push_back({mirror, 0.0});
      });
    }
  }
  return wanted;
}

/// Calls f(block) for the blocks that contain mirror nodes of those nodes of a block that may be in contact with their
/// images: a rank that uses one of the blocks requires the other.
template <class Function>
void Topology::for_each_mirror_block(const BlockCoordinate& block, Function&& f) const {
  for (std::size_t face = 0; face < 6; ++face) {
    if (!apart_at_[face]) continue;
    const std::size_t a = face / 2;
    const std::int32_t at = face % 2 == 0 ? 0 : geometry(block).cells[a], edge = block_.along(a);
    for (std::int32_t k = at - mirror_reach; k <= at + mirror_reach; ++k) {
      if (k < block[a] * edge || k >= (block[a] + 1) * edge) continue;
      BlockCoordinate mirror = block;
      mirror[a] = (2 * at - k + edge) / edge - 1;  // floor for >= -edge
      if (contains(mirror)) f(mirror);
    }
  }
}

void Topology::adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                     Stencil stencil, const Work& work) {
  ++adaptations_;
  wanted_.resize(forests_.size());
  for (const Level level : levels()) {
    std::vector<WantedBlock>& wanted = wanted_[number(level)];
    wanted = wanted_blocks(level, position, velocity, lookahead, stencil, work);
    forests_[number(level)].adapt(wanted);
  }
}

std::vector<int> Topology::owners(std::span<const Vector3> position) const {
  std::vector<int> owner(position.size(), 0);
  if (parallel::size(communicator_) == 1) return owner;
  BlockTable known;
  known.reserve(slots() + 64);
  // Of the block of the particle before: particles adjacent in memory are mostly in one block
  Lanes corner{};
  for (std::size_t p = 0; p < position.size(); ++p) {
    if (p > 0 && !has_two_levels() && is_inside(geometry().in_cells(position[p]) - corner, edges_)) {
      owner[p] = owner[p - 1];
      continue;
    }
    const std::optional<BlockCoordinate> block = block_of(position[p]);
    if (!block) throw InternalError("the owner of a particle outside of the domain was asked for");
    corner = corner_of(*block, block_);
    std::int32_t& rank = known.find_or_insert(*block, BlockTable::none);
    if (rank == BlockTable::none) rank = forests_[number(block->level)].owner(*block);
    owner[p] = rank;
  }
  return owner;
}

void Topology::owners_reached(const Vector3& position, Stencil stencil, std::vector<int>& ranks) const {
  const Blend blend = geometry().blend(position);
  for (const Level level : levels()) {
    if (!(blend.share(level) > 0.0)) continue;
    const std::optional<BlockCoordinate> block = block_of(position, level);
    if (!block) return;
    const Lanes local = geometry(*block).in_cells(position) - corner_of(*block, block_);
    for_each_bit(touched_neighbours(local, stencil), [&](unsigned n) {
      const BlockCoordinate reached = shifted(*block, static_cast<int>(n));
      if (!contains(reached)) return;
      const int rank = forests_[number(level)].owner(reached);
      if (std::ranges::find(ranks, rank) == ranks.end()) ranks.push_back(rank);
    });
  }
}

void Topology::activate(std::span<const Vector3> position, std::span<const Vector3> velocity,
                        double lookahead, Stencil stencil) {
  std::vector<BlockSet> of_level;
  for (const Level level : levels()) {
    std::vector<WantedBlock>& wanted = wanted_[number(level)];
    // With several ranks, particles may have been exchanged since `adapt`.
    if (is_shared()) wanted = wanted_blocks(level, position, velocity, lookahead, stencil, {});
    of_level.push_back(forests_[number(level)].claim(wanted));
  }
  blocks_ = joined(of_level);
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
    corner_[s] = corner_of(block, block_);
    // Each pair of neighbours is looked up once, from one side.
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
}

void Topology::shift(const Vector3& cells) {
  if (has_two_levels()) throw InternalError("a grid of two levels cannot be shifted");
  geometries_.front().lower = origin_ + geometry().cell_size * cells;
  foresight_ = 1.0;  // from half a cell on one side to half a cell on the other
}

namespace {

template <class Bits>
void join_bits(MPI_Comm communicator, const std::vector<BlockSet::Peer>& peers, std::vector<Bits>& of_slot) {
  constexpr int tag = 13;
  const auto one = [](std::size_t) { return std::size_t{1}; };
  const auto pack = [&](std::size_t slot, Bits* out) { *out = of_slot[slot]; };
  exchange<Bits>(communicator, peers, tag, &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, one, pack,
                 [&](std::size_t slot, const Bits* in) { of_slot[slot] |= *in; });
  exchange<Bits>(communicator, peers, tag, &BlockSet::Peer::lent, &BlockSet::Peer::borrowed, one, pack,
                 [&](std::size_t slot, const Bits* in) { of_slot[slot] = *in; });
}

}  // namespace

void Topology::join_bits_of_ranks(std::vector<std::uint64_t>& of_slot) {
  join_bits(communicator_, peers(), of_slot);
}

void Topology::join_bits_of_ranks(std::vector<FieldSet>& of_slot) {
  join_bits(communicator_, peers(), of_slot);
}

}  // namespace whipple::grid
