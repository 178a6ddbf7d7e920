// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/grid/geometry.hpp"

/// What nodes hold, and lists and values that go with their blocks.
namespace whipple::grid {

/// Payload of a node, two registers of four doubles (SI).
/// After particles_to_grid: `first` = mass, momentum x y z;           `second` = mass * sound speed, force x
/// y z. After the grid update:   `first` = velocity x y z, relaxation beta; `second` = velocity increment x y
/// z, heat per mass (J/kg) that contact gives to the particles around (docs/theory/contact.md, 4).
struct alignas(64) Node {
  Lanes first;
  Lanes second;
};

constexpr int neighbour_index(int x, int y, int z) { return (x * 3 + y) * 3 + z; }

/// Points by block.
struct PointList {
  std::vector<std::uint32_t> begin;   ///< of each slot in `points`, and the end
  std::vector<std::uint32_t> points;  ///< indices, block by block

  [[nodiscard]] std::span<const std::uint32_t> in(std::size_t slot) const {
    return std::span(points).subspan(begin[slot], begin[slot + 1] - begin[slot]);
  }
};

/// Calls f(position) for every bit that is set, from the lowest.
template <class Function>
void for_each_bit(std::uint64_t bits, Function&& f) {
  for (; bits != 0; bits &= bits - 1) f(static_cast<unsigned>(std::countr_zero(bits)));
}

/// Values that go with the contact slots of a grid: those of slot number c stand from begin[c] to begin[c +
/// 1].
struct ContactValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// Values that go with all blocks of nodes of some slots, of which every rank that works with them knows as
/// many: those of slot s stand from begin[s] to begin[s + 1].
struct SlotValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// A node beyond a mirror plane and its image inside, as indices into all_nodes().
struct MirrorPair {
  std::uint32_t outside;
  std::uint32_t image;
};
constexpr std::uint32_t no_node = static_cast<std::uint32_t>(-1);
struct MirrorPlane {
  int face = 0;  ///< in the order of Geometry::boundary
  int axis = 0;
  Boundary kind = Boundary::symmetry;
  /// Pairs of fields that are continuous with their mirror images (`bond_at_planes`).
  std::vector<MirrorPair> pairs;
  std::vector<std::uint32_t> on_plane;
  /// Pairs of fields that are in contact with their mirror images.
  std::vector<MirrorPair> pairs_apart;
  std::vector<std::uint32_t> on_plane_apart;
  /// Inner nodes that particles may reach from beyond the plane: the images of some rank's `outside` nodes.
  std::vector<std::uint32_t> near;
  [[nodiscard]] double outward() const { return face % 2 == 0 ? -1.0 : 1.0; }
};

}  // namespace whipple::grid
