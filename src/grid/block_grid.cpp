// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/block_grid.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "src/base/error.hpp"
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
    : geometry_(geometry), forest_(geometry, communicator) {
  for (int face = 0; face < 6; ++face) {
    const Boundary boundary = geometry.boundary[static_cast<std::size_t>(face)];
    if (boundary == Boundary::outflow) continue;
    planes_.push_back(
        {.axis = face / 2, .no_slip = boundary == Boundary::no_slip, .pairs = {}, .on_plane = {}});
  }
}

BlockCoordinate BlockGrid::block_of(const Vector3& position, std::size_t index) const {
  BlockCoordinate block{};
  const Vector3 in_cells = geometry_.in_cells(position);
  for (int a = 0; a < 3; ++a) {
    const double cells = in_cells[a];
    // The negation also catches NaN.
    if (!(cells > -1.0 && cells < geometry_.cells[static_cast<std::size_t>(a)] + 1.0)) {
      throw StateError(
          fmt::format("particle with index {} is outside of the domain: position {} m along axis {}", index,
                      position[a], "xyz"[a]));
    }
    block[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(std::floor(cells / block_edge));
  }
  return block;
}

void BlockGrid::bin(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                    Stencil stencil) {
  if (slot_of_particle_.size() != position.size() || !locate(position, stencil)) {
    adapt(position, velocity, lookahead, stencil);
    if (!locate(position, stencil)) throw InternalError("adaptation left a particle without its blocks");
  }
  list_particles(position.size());
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
        const double offset = block - coordinate_[slot][a];
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

void BlockGrid::adapt(std::span<const Vector3> position, std::span<const Vector3> velocity, double lookahead,
                      Stencil stencil) {
  ++adaptations_;
  // Blocks with particles, and for each the neighbours that its particles reach now and within the
  // look-ahead.
  BlockTable homes;
  homes.reserve(coordinate_.size() + 64);
  std::vector<BlockCoordinate> home;
  std::vector<std::uint32_t> wanted_mask;
  for (std::size_t p = 0; p < position.size(); ++p) {
    const BlockCoordinate block = block_of(position[p], p);
    const std::int32_t i = homes.find_or_insert(block, static_cast<std::int32_t>(home.size()));
    if (static_cast<std::size_t>(i) == home.size()) {
      home.push_back(block);
      wanted_mask.push_back(0);
    }
    Vector3 local = geometry_.in_cells(position[p]);
    for (std::size_t a = 0; a < 3; ++a) local[static_cast<Eigen::Index>(a)] -= block[a] * block_edge;
    const Vector3 ahead = (velocity[p] * (lookahead / geometry_.cell_size)).cwiseMax(-2.0).cwiseMin(2.0);
    wanted_mask[static_cast<std::size_t>(i)] |= touched_neighbours(local, ahead, stencil);
  }
  BlockTable wanted_table;
  wanted_table.reserve(2 * home.size());
  std::vector<BlockCoordinate> wanted;
  for (std::size_t i = 0; i < home.size(); ++i) {
    for (int n = 0; n < 27; ++n) {
      if ((wanted_mask[i] >> n & 1U) == 0) continue;
      const BlockCoordinate block = shifted(home[i], n);
      bool inside = true;  // motion may foresee blocks beyond the outer layer
      for (std::size_t a = 0; a < 3; ++a) {
        inside = inside && block[a] >= -1 && block[a] <= geometry_.blocks(static_cast<int>(a));
      }
      if (!inside) continue;
      const auto next = static_cast<std::int32_t>(wanted.size());
      if (wanted_table.find_or_insert(block, next) == next) wanted.push_back(block);
    }
  }

  coordinate_ = forest_.adapt(wanted);
  table_.reserve(coordinate_.size());
  for (std::size_t s = 0; s < coordinate_.size(); ++s) {
    table_.find_or_insert(coordinate_[s], static_cast<std::int32_t>(s));
  }
  neighbours_.resize(coordinate_.size());
  existing_.assign(coordinate_.size(), 0);
  parallel::for_each(coordinate_.size(), [&](std::size_t s) {
    for (int n = 0; n < 27; ++n) {
      const std::int32_t slot = table_.find(shifted(coordinate_[s], n));
      neighbours_[s][static_cast<std::size_t>(n)] = slot;
      if (slot != no_slot) existing_[s] |= 1U << n;
    }
  });
  nodes_.resize(coordinate_.size() * nodes_per_block);
  slot_of_particle_.resize(position.size());
  for (std::size_t p = 0; p < position.size(); ++p)
    slot_of_particle_[p] = table_.find(block_of(position[p], p));
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
    const BlockCoordinate& c = coordinate_[s];
    colours_[static_cast<std::size_t>((c[0] & 1) << 2 | (c[1] & 1) << 1 | (c[2] & 1))].push_back(
        static_cast<std::uint32_t>(s));
  }
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
    const auto axis = static_cast<std::size_t>(mirror.axis);
    const std::int32_t at = face % 2 == 0 ? 0 : geometry_.cells[axis];
    const std::int32_t outward = face % 2 == 0 ? -1 : 1;
    for (std::size_t s = 0; s < slots(); ++s) {
      for (int i = 0; i < nodes_per_block; ++i) {
        const std::array<int, 3> inside_block = {i / 16, i / 4 % 4, i % 4};
        const std::int32_t along = coordinate_[s][axis] * block_edge + inside_block[axis];
        const auto index = static_cast<std::uint32_t>(s * nodes_per_block + static_cast<std::size_t>(i));
        if (along == at) mirror.on_plane.push_back(index);
        if ((along - at) * outward <= 0) continue;
        outside_[index] = 1;
        std::array<std::int32_t, 3> image{};
        for (std::size_t a = 0; a < 3; ++a) image[a] = coordinate_[s][a] * block_edge + inside_block[a];
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
