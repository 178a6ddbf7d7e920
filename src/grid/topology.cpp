// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_reach.hpp"
#include "src/grid/slot_messages.hpp"

namespace whipple::grid {
namespace {

BlockCoordinate shifted(const BlockCoordinate& block, int neighbour) {
  return {block[0] + neighbour / 9 - 1, block[1] + neighbour / 3 % 3 - 1, block[2] + neighbour % 3 - 1};
}

}  // namespace

Topology::Topology(const Geometry& geometry, MPI_Comm communicator)
    : communicator_(communicator),
      geometry_(geometry),
      origin_(geometry.lower),
      block_(geometry.block()),
      edges_(block_.edges()),
      forest_(geometry, communicator) {}

bool Topology::is_shared() const { return parallel::size(communicator_) > 1; }

std::optional<BlockCoordinate> Topology::block_of(const Vector3& position) const {
  BlockCoordinate block{};
  const Lanes at = in_cells(position);
  for (std::size_t a = 0; a < 3; ++a) {
    const double cells = at[a];
    if (!(cells > -1.0 && cells < geometry_.cells[a] + 1.0)) return std::nullopt;
    block[a] = static_cast<std::int32_t>(std::floor(cells / block_.along(a)));
  }
  return block;
}

std::vector<WantedBlock> Topology::wanted_blocks(std::span<const Vector3> position,
                                                 std::span<const Vector3> velocity, double lookahead,
                                                 Stencil stencil, const Work& work) const {
  // Blocks with particles, and for each the neighbours that its particles reach now and within the look-ahead: first
  // collected for consecutive particles in one block.
  struct Home {
    WantedBlock block;
    std::uint32_t wanted = 0;  // one bit per neighbour; 0 without points on the grid
  };
  std::vector<std::vector<Home>> homes_of(parallel::chunk_count(position.size()));
  std::atomic<bool> outside = false;
  parallel::for_each_chunk(position.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Home>& homes = homes_of[begin / parallel::chunk_size];
    Lanes corner{};  // of the last home
    for (std::size_t p = begin; p < end; ++p) {
      const Lanes at = in_cells(position[p]);
      const bool on_grid = p + work.apart < position.size();
      if (homes.empty() || !is_inside(at - corner, edges_)) {
        const std::optional<BlockCoordinate> block = block_of(position[p]);
        if (!block) {
          outside = true;
          return;
        }
        homes.push_back({{*block, 0.0}, 0});
        corner = corner_of(*block, block_);
      }
      Home& home = homes.back();
      home.block.weight += p < work.of_particle.size() ? work.of_particle[p] : 1.0;
      if (!on_grid) continue;
      const Lanes motion = load_vector(velocity[p].data()) * (lookahead / geometry_.cell_size);
      const Lanes ahead = maximum(minimum(motion, broadcast(2.0)), broadcast(-2.0));
      home.wanted |= touched_neighbours(at - corner, ahead, stencil, foresight_);
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

  BlockTable wanted_table;
  wanted_table.reserve(2 * home.size());
  std::vector<WantedBlock> wanted;
  for (const Home& of_block : home) {
    for (int n = 0; n < 27; ++n) {
      if ((of_block.wanted >> n & 1U) == 0) continue;
      const BlockCoordinate block = shifted(of_block.block.coordinate, n);
      bool inside = true;  // the motion may lead beyond the outer layer
      for (std::size_t a = 0; a < 3; ++a) {
        inside = inside && block[a] >= -1 && block[a] <= geometry_.blocks(static_cast<int>(a));
      }
      if (!inside) continue;
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
    const std::int32_t at = face % 2 == 0 ? 0 : geometry_.cells[a], edge = block_.along(a);
    for (std::int32_t k = at - mirror_reach; k <= at + mirror_reach; ++k) {
      if (k < block[a] * edge || k >= (block[a] + 1) * edge) continue;
      BlockCoordinate mirror = block;
      mirror[a] = (2 * at - k + edge) / edge - 1;  // floor for >= -edge
      if (mirror[a] >= -1 && mirror[a] <= geometry_.blocks(static_cast<int>(a))) f(mirror);
    }
  }
}

void Topology::adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                     Stencil stencil, const Work& work) {
  ++adaptations_;
  wanted_ = wanted_blocks(position, velocity, lookahead, stencil, work);
  forest_.adapt(wanted_);
}

std::vector<int> Topology::owners(std::span<const Vector3> position) const {
  std::vector<int> owner(position.size(), 0);
  if (parallel::size(communicator_) == 1) return owner;
  BlockTable known;
  known.reserve(slots() + 64);
  // Of the block of the particle before: particles adjacent in memory are mostly in one block
  Lanes corner{};
  for (std::size_t p = 0; p < position.size(); ++p) {
    if (p > 0 && is_inside(in_cells(position[p]) - corner, edges_)) {
      owner[p] = owner[p - 1];
      continue;
    }
    const std::optional<BlockCoordinate> block = block_of(position[p]);
    if (!block) throw InternalError("the owner of a particle outside of the domain was asked for");
    corner = corner_of(*block, block_);
    std::int32_t& rank = known.find_or_insert(*block, BlockTable::none);
    if (rank == BlockTable::none) rank = forest_.owner(*block);
    owner[p] = rank;
  }
  return owner;
}

void Topology::owners_reached(const Vector3& position, Stencil stencil, std::vector<int>& ranks) const {
  const std::optional<BlockCoordinate> block = block_of(position);
  if (!block) return;
  for_each_bit(touched_neighbours(in_cells(position) - corner_of(*block, block_), stencil), [&](unsigned n) {
    const BlockCoordinate reached = shifted(*block, static_cast<int>(n));
    for (std::size_t a = 0; a < 3; ++a) {
      if (reached[a] < -1 || reached[a] > geometry_.blocks(static_cast<int>(a))) return;
    }
    const int rank = forest_.owner(reached);
    if (std::ranges::find(ranks, rank) == ranks.end()) ranks.push_back(rank);
  });
}

void Topology::activate(std::span<const Vector3> position, std::span<const Vector3> velocity,
                        double lookahead, Stencil stencil) {
  // With several ranks, particles may have been exchanged since `adapt`.
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
  geometry_.lower = origin_ + geometry_.cell_size * cells;
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
