// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/block_grid.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "src/base/error.hpp"
#include "src/parallel/mpi.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::grid {
namespace {

/// Along one direction: does something reach the block before (bit 0), after (bit 1)?
using AxisReach = unsigned;

/// Bit per neighbour that a reach given per direction touches, always with the block itself.
constexpr std::array<std::uint32_t, 64> neighbour_masks() {
  std::array<std::uint32_t, 64> masks{};
  for (unsigned reach = 0; reach < 64; ++reach) {
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        for (int z = 0; z < 3; ++z) {
          const auto touched = [](AxisReach axis, int offset) {
            return offset == 1 || (offset == 0 && (axis & 1U) != 0) || (offset == 2 && (axis & 2U) != 0);
          };
          if (touched(reach & 3U, x) && touched(reach >> 2 & 3U, y) && touched(reach >> 4, z)) {
            masks[reach] |= 1U << neighbour_index(x, y, z);
          }
        }
      }
    }
  }
  return masks;
}
constexpr std::array<std::uint32_t, 64> masks = neighbour_masks();

/// Nodes beyond a mirror plane that the stencil of a particle before it may hold.
constexpr std::int32_t mirror_reach = 2;

/// Neighbours that the nodes of a stencil fall into when the particle is at `local` (cells from the block's
/// lower corner), with `ahead` cells of motion before it.
std::uint32_t touched_neighbours(const Vector3& local, const Vector3& ahead, Stencil stencil) {
  unsigned reach = 0;
  for (int a = 0; a < 3; ++a) {
    const double first = std::floor(local[a] + std::min(ahead[a], 0.0) - stencil.shift);
    const double last = std::floor(local[a] + std::max(ahead[a], 0.0) - stencil.shift) + stencil.count - 1;
    const AxisReach axis = (first < 0 ? 1U : 0U) | (last >= block_edge ? 2U : 0U);
    reach |= axis << (2 * a);
  }
  return masks[reach];
}

BlockCoordinate shifted(const BlockCoordinate& block, int neighbour) {
  return {block[0] + neighbour / 9 - 1, block[1] + neighbour / 3 % 3 - 1, block[2] + neighbour % 3 - 1};
}

}  // namespace

BlockGrid::BlockGrid(const Geometry& geometry, MPI_Comm communicator)
    : communicator_(communicator), geometry_(geometry), forest_(geometry, communicator) {
  for (int face = 0; face < 6; ++face) {
    const Boundary boundary = geometry.boundary[static_cast<std::size_t>(face)];
    if (boundary == Boundary::outflow) continue;
    planes_.push_back({.axis = face / 2,
                       .no_slip = boundary == Boundary::no_slip,
                       .pairs = {},
                       .on_plane = {},
                       .near = {}});
  }
}

/// Nothing for a position beyond the outer layer, or NaN.
std::optional<BlockCoordinate> BlockGrid::block_of(const Vector3& position) const {
  BlockCoordinate block{};
  const Vector3 in_cells = geometry_.in_cells(position);
  for (std::size_t a = 0; a < 3; ++a) {
    const double cells = in_cells[static_cast<Eigen::Index>(a)];
    if (!(cells > -1.0 && cells < geometry_.cells[a] + 1.0)) return std::nullopt;
    block[a] = static_cast<std::int32_t>(std::floor(cells / block_edge));
  }
  return block;
}

bool BlockGrid::bin(std::span<const Vector3> position, Stencil stencil) {
  const bool complete = slot_of_particle_.size() == position.size() && locate(position, stencil);
  if (parallel::any(communicator_, !complete)) return false;
  list_particles(position.size());
  return true;
}

/// Updates the slot of every particle from its former slot; false if a particle left the active set.
bool BlockGrid::locate(std::span<const Vector3> position, Stencil stencil) {
  std::atomic<bool> complete = true;
  parallel::for_each_chunk(position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      auto slot = static_cast<std::size_t>(slot_of_particle_[p]);
      Vector3 local = geometry_.in_cells(position[p]);
      int neighbour = 0;
      bool far = false;
      for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        const double block = std::floor(local[axis] / block_edge);
        const double offset = block - blocks_.coordinate[slot][a];
        far = far || !(std::abs(offset) <= 1.0);
        neighbour = neighbour * 3 + (far ? 0 : static_cast<int>(offset) + 1);
        local[axis] -= block * block_edge;
      }
      const std::int32_t moved = far ? no_slot : neighbours_[slot][static_cast<std::size_t>(neighbour)];
      if (moved == no_slot) {
        complete = false;
        return;
      }
      slot = static_cast<std::size_t>(moved);
      slot_of_particle_[p] = moved;
      if ((touched_neighbours(local, Vector3::Zero(), stencil) & ~existing_[slot]) != 0) complete = false;
    }
  });
  return complete;
}

std::vector<WantedBlock> BlockGrid::wanted_blocks(std::span<const Vector3> position,
                                                  std::span<const Vector3> velocity, double lookahead,
                                                  Stencil stencil, double weight) const {
  // Blocks with particles, and for each the neighbours that its particles reach now and within the
  // look-ahead.
  BlockTable homes;
  homes.reserve(slots() + 64);
  std::vector<WantedBlock> home;
  std::vector<std::uint32_t> wanted_mask;
  std::string error;
  for (std::size_t p = 0; p < position.size(); ++p) {
    const std::optional<BlockCoordinate> block = block_of(position[p]);
    if (!block) {
      error = fmt::format("particle with index {} is outside of the domain: position ({}, {}, {}) m", p,
                          position[p][0], position[p][1], position[p][2]);
      break;
    }
    const std::int32_t i = homes.find_or_insert(*block, static_cast<std::int32_t>(home.size()));
    if (static_cast<std::size_t>(i) == home.size()) {
      home.push_back({*block, 0.0});
      wanted_mask.push_back(0);
    }
    home[static_cast<std::size_t>(i)].weight += weight;
    Vector3 local = geometry_.in_cells(position[p]);
    for (std::size_t a = 0; a < 3; ++a) local[static_cast<Eigen::Index>(a)] -= (*block)[a] * block_edge;
    const Vector3 ahead = (velocity[p] * (lookahead / geometry_.cell_size)).cwiseMax(-2.0).cwiseMin(2.0);
    wanted_mask[static_cast<std::size_t>(i)] |= touched_neighbours(local, ahead, stencil);
  }
  parallel::throw_together(communicator_, error);

  BlockTable wanted_table;
  wanted_table.reserve(2 * home.size());
  std::vector<WantedBlock> wanted;
  for (std::size_t i = 0; i < home.size(); ++i) {
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
                      Stencil stencil, double weight) {
  ++adaptations_;
  wanted_ = wanted_blocks(position, velocity, lookahead, stencil, weight);
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

void BlockGrid::activate(std::span<const Vector3> position, std::span<const Vector3> velocity,
                         double lookahead, Stencil stencil) {
  // Particles may have come and gone since `adapt`, unless there is no other rank.
  if (parallel::size(communicator_) > 1) {
    wanted_ = wanted_blocks(position, velocity, lookahead, stencil, 0.0);
  }
  blocks_ = forest_.claim(wanted_);
  table_.reserve(slots());
  for (std::size_t s = 0; s < slots(); ++s) {
    table_.find_or_insert(blocks_.coordinate[s], static_cast<std::int32_t>(s));
  }
  neighbours_.resize(slots());
  existing_.assign(slots(), 0);
  parallel::for_each(slots(), [&](std::size_t s) {
    for (int n = 0; n < 27; ++n) {
      const std::int32_t slot = table_.find(shifted(blocks_.coordinate[s], n));
      neighbours_[s][static_cast<std::size_t>(n)] = slot;
      if (slot != no_slot) existing_[s] |= 1U << n;
    }
  });
  nodes_.resize(slots() * nodes_per_block);
  slot_of_particle_.resize(position.size());
  for (std::size_t p = 0; p < position.size(); ++p)
    slot_of_particle_[p] = table_.find(*block_of(position[p]));
  find_mirror_nodes();
}

/// Counting sort by slot; stable, so that the particles of a block keep the order of their indices.
void BlockGrid::list_particles(std::size_t n) {
  begin_.assign(slots() + 1, 0);
  for (std::size_t p = 0; p < n; ++p) ++begin_[static_cast<std::size_t>(slot_of_particle_[p]) + 1];
  for (std::size_t s = 0; s < slots(); ++s) begin_[s + 1] += begin_[s];
  particles_.resize(n);
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t p = 0; p < n; ++p) {
    particles_[next[static_cast<std::size_t>(slot_of_particle_[p])]++] = static_cast<std::uint32_t>(p);
  }
  for (auto& colour : colours_) colour.clear();
  for (std::size_t s = 0; s < slots(); ++s) {
    if (begin_[s + 1] == begin_[s]) continue;
    const BlockCoordinate& c = blocks_.coordinate[s];
    colours_[static_cast<std::size_t>((c[0] & 1) << 2 | (c[1] & 1) << 1 | (c[2] & 1))].push_back(
        static_cast<std::uint32_t>(s));
  }
}

template <class Receive>
void BlockGrid::exchange_nodes(Part part, std::vector<std::uint32_t> BlockSet::Peer::* from,
                               std::vector<std::uint32_t> BlockSet::Peer::* to, Receive&& receive) {
  const std::vector<BlockSet::Peer>& peers = blocks_.peers;
  const std::size_t registers = part == Part::both ? 2 : 1;
  const std::size_t per_block = registers * nodes_per_block;
  constexpr int tag = 11;
  outgoing_.resize(peers.size());
  incoming_.resize(peers.size());
  std::vector<MPI_Request> requests(2 * peers.size(), MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    incoming_[i].resize((peers[i].*to).size() * per_block);
    MPI_Irecv(incoming_[i].data(), static_cast<int>(4 * incoming_[i].size()), MPI_DOUBLE, peers[i].rank, tag,
              communicator_, &requests[2 * i]);
  }
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const std::vector<std::uint32_t>& slots_sent = peers[i].*from;
    outgoing_[i].resize(slots_sent.size() * per_block);
    parallel::for_each(slots_sent.size(), [&](std::size_t b) {
      const Node* block = nodes(slots_sent[b]);
      Lanes* out = &outgoing_[i][b * per_block];
      for (std::size_t n = 0; n < nodes_per_block; ++n) {
        out[registers * n] = block[n].first;
        if (part == Part::both) out[registers * n + 1] = block[n].second;
      }
    });
    MPI_Isend(outgoing_[i].data(), static_cast<int>(4 * outgoing_[i].size()), MPI_DOUBLE, peers[i].rank, tag,
              communicator_, &requests[2 * i + 1]);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t i = 0; i < peers.size(); ++i) {  // in the order of the ranks: sums are repeatable
    const std::vector<std::uint32_t>& slots_received = peers[i].*to;
    parallel::for_each(slots_received.size(), [&](std::size_t b) {
      Node* block = nodes(slots_received[b]);
      const Lanes* in = &incoming_[i][b * per_block];
      for (std::size_t n = 0; n < nodes_per_block; ++n) receive(block[n], in + registers * n);
    });
  }
}

void BlockGrid::sum_to_owners(Part part) {
  exchange_nodes(part, &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, [part](Node& node, const Lanes* in) {
    node.first += in[0];
    if (part == Part::both) node.second += in[1];
  });
}

void BlockGrid::borrow_from_owners(Part part) {
  exchange_nodes(part, &BlockSet::Peer::lent, &BlockSet::Peer::borrowed, [part](Node& node, const Lanes* in) {
    node.first = in[0];
    if (part == Part::both) node.second = in[1];
  });
}

void BlockGrid::clear() {
  parallel::for_each(slots(), [&](std::size_t s) {
    Node* block = nodes(s);
    for (int i = 0; i < nodes_per_block; ++i) block[i] = {broadcast(0.0), broadcast(0.0)};
  });
}

void BlockGrid::find_mirror_nodes() {
  if (planes_.empty()) return;
  outside_.assign(nodes_.size(), 0);
  std::size_t plane = 0;
  for (int face = 0; face < 6; ++face) {
    if (geometry_.boundary[static_cast<std::size_t>(face)] == Boundary::outflow) continue;
    MirrorPlane& mirror = planes_[plane++];
    mirror.pairs.clear();
    mirror.on_plane.clear();
    mirror.near.clear();
    const auto axis = static_cast<std::size_t>(mirror.axis);
    const std::int32_t at = face % 2 == 0 ? 0 : geometry_.cells[axis];
    const std::int32_t outward = face % 2 == 0 ? -1 : 1;
    for (std::size_t s = 0; s < slots(); ++s) {
      for (int i = 0; i < nodes_per_block; ++i) {
        const std::array<int, 3> inside_block = {i / 16, i / 4 % 4, i % 4};
        const std::int32_t along = blocks_.coordinate[s][axis] * block_edge + inside_block[axis];
        const auto index = static_cast<std::uint32_t>(s * nodes_per_block + static_cast<std::size_t>(i));
        if (along == at) mirror.on_plane.push_back(index);
        const std::int32_t inside = (at - along) * outward;
        if (inside > 0 && inside <= mirror_reach) mirror.near.push_back(index);
        if (inside >= 0) continue;
        outside_[index] = 1;
        std::array<std::int32_t, 3> image{};
        for (std::size_t a = 0; a < 3; ++a)
          image[a] = blocks_.coordinate[s][a] * block_edge + inside_block[a];
        image[axis] = 2 * at - image[axis];
        BlockCoordinate block{};
        for (std::size_t a = 0; a < 3; ++a)
          block[a] = (image[a] + block_edge) / block_edge - 1;  // floor for >= -4
        if (image[axis] < -block_edge) continue;
        const std::int32_t slot = table_.find(block);
        if (slot == no_slot)
          continue;  // no particle reaches so far beyond the plane: its stencil is symmetric
        const int node = node_index(image[0] - block[0] * block_edge, image[1] - block[1] * block_edge,
                                    image[2] - block[2] * block_edge);
        mirror.pairs.push_back({index, static_cast<std::uint32_t>(slot * nodes_per_block + node)});
      }
    }
  }
}

std::size_t BlockGrid::bytes() const {
  return nodes_.size() * sizeof(Node) + slots() * (sizeof(neighbours_[0]) + sizeof(BlockCoordinate)) +
         slot_of_particle_.size() * 8;
}

}  // namespace whipple::grid
