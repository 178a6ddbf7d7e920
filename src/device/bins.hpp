// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/device/lattice.hpp"
#include "src/device/points.hpp"

/// Kernels that assign particles to blocks and cells. Each is called for all i of a range, in any order: it writes what
/// belongs to i alone, except for flags that all who write them set to 1.
namespace whipple::device {

/// Computes the key of each particle, 64 times its block plus the place of the first node of its stencil there, and
/// flags the blocks that it reaches.
template <class Lattice>
struct FindPlaces {
  Lattice lattice;
  Points points;
  const std::uint8_t* field_of_body;
  std::uint32_t *keys, *order;  ///< of each particle; itself
  std::uint32_t* reached;       ///< of each block of each field

  WHIPPLE_POINT void operator()(std::size_t p) const {
    const Place first = Lattice::first_node(lattice.in_cells(points.vector(position, p)));
    const std::uint32_t field = field_of_body[points.body[p]];
    keys[p] = lattice.block_at(field, first) * block_nodes + Lattice::inside(first);
    order[p] = static_cast<std::uint32_t>(p);
    constexpr int last = stencil_edge - 1, corners = Lattice::planar ? 4 : 8;
    for (int corner = 0; corner < corners; ++corner) {
      const Place at = {first.x + ((corner & 1) != 0 ? last : 0), first.y + ((corner & 2) != 0 ? last : 0),
                        first.z + ((corner & 4) != 0 ? last : 0)};
      reached[lattice.block_at(field, at)] = 1;
    }
  }
};

/// Gives slots to the blocks that are reached, in their order.
struct NumberSlots {
  const std::uint32_t *reached, *before;  ///< of each block: whether it is, and how many are before it
  std::int32_t* slot_of_block;
  std::uint32_t* block_of_slot;

  WHIPPLE_POINT void operator()(std::size_t block) const {
    const bool has = reached[block] != 0;
    slot_of_block[block] = has ? static_cast<std::int32_t>(before[block]) : nowhere;
    if (has) block_of_slot[before[block]] = static_cast<std::uint32_t>(block);
  }
};

/// Flags the first particle of each cell in the order of the keys.
struct FlagCells {
  const std::uint32_t* keys;
  std::uint32_t* first;
  WHIPPLE_POINT void operator()(std::size_t i) const { first[i] = i == 0 || keys[i] != keys[i - 1] ? 1 : 0; }
};

/// Gives numbers to the cells.
template <class Lattice>
struct NumberCells {
  Lattice lattice;
  const std::uint32_t *keys, *first, *before;
  std::uint32_t* cell_begin;
  std::int32_t* cell_at_node;      ///< cleared to nowhere
  std::uint32_t* cell_of_ordered;  ///< of the particle at a position of the order

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const std::uint32_t cell = before[i] + first[i] - 1;
    cell_of_ordered[i] = cell;
    if (first[i] == 0) return;
    cell_begin[cell] = static_cast<std::uint32_t>(i);
    const std::uint32_t key = keys[i];
    const auto slot = static_cast<std::uint32_t>(lattice.slot_of_block[key / block_nodes]);
    cell_at_node[slot * block_nodes + key % block_nodes] = static_cast<std::int32_t>(cell);
  }
};

/// Lists the nodes of each cell.
template <class Lattice>
struct ListNodes {
  Lattice lattice;
  const std::uint32_t* keys;
  std::int32_t* nodes_of_cell;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto cell = static_cast<std::uint32_t>(i / Lattice::stencil_nodes);
    const Place n = Lattice::in_stencil(static_cast<int>(i % Lattice::stencil_nodes));
    const std::uint32_t key = keys[lattice.cell_begin[cell]];
    const std::uint32_t slot = static_cast<std::uint32_t>(lattice.slot_of_block[key / block_nodes]);
    const Place first = lattice.place_of(slot * block_nodes + key % block_nodes);
    nodes_of_cell[i] =
        lattice.node_at(lattice.field_of(slot * block_nodes), {first.x + n.x, first.y + n.y, first.z + n.z});
  }
};

/// Rearranges one component of the particles, and its counterparts of whole numbers.
template <class Number>
struct Gather {
  const Number* from;
  const std::uint32_t* order;
  Number* to;
  WHIPPLE_POINT void operator()(std::size_t i) const { to[i] = from[order[i]]; }
};
template <class Number>
struct Copy {
  const Number* from;
  Number* to;
  WHIPPLE_POINT void operator()(std::size_t i) const { to[i] = from[i]; }
};
/// Writes 0, 1, 2 ...
struct Iota {
  std::uint32_t* to;
  WHIPPLE_POINT void operator()(std::size_t i) const { to[i] = static_cast<std::uint32_t>(i); }
};
template <class Number>
struct Fill {
  Number* to;
  Number value;
  WHIPPLE_POINT void operator()(std::size_t i) const { to[i] = value; }
};

}  // namespace whipple::device
