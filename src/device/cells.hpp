// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "src/core/base/error.hpp"
#include "src/device/bins.hpp"
#include "src/device/problem.hpp"

namespace whipple::device {

/// Keeps the lattice of a step: which blocks have nodes, and which particles are in which cell.
template <class Space, class Lattice>
class Cells {
 public:
  template <class T>
  using Array = typename Space::template Array<T>;

  /// @throws StateError if the domain has too many cells
  explicit Cells(const Problem& problem) : lattice_(lattice_of<Lattice>(problem)) {
    if (has_too_many_cells(problem)) throw StateError("the domain has too many cells for the device");
    reached_.reserve(blocks());
    slot_of_block_.reserve(blocks());
  }

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  [[nodiscard]] std::size_t nodes() const { return std::size_t{lattice_.slots} * block_nodes; }
  [[nodiscard]] std::size_t stencils() const {
    return std::size_t{lattice_.stencil_cells} * Lattice::stencil_nodes;
  }
  [[nodiscard]] const std::uint32_t* cell_of_ordered() { return cell_of_ordered_.data(); }
  [[nodiscard]] Node* sums() { return sums_.data(); }

  /// Returns the particles, cell by cell.
  [[nodiscard]] const std::uint32_t* order() { return order_.data(); }

  /// Assigns the particles to blocks and cells at their present positions.
  void bin(Space& space, const Points& points, const std::uint8_t* field_of_body) {
    const std::size_t n = points.size;
    for (Array<std::uint32_t>* of : {&keys_, &order_, &first_, &cell_of_ordered_}) of->reserve(n);
    before_.reserve(std::max(blocks(), n));
    space.for_each(blocks(), Fill<std::uint32_t>{reached_.data(), 0});
    space.for_each(n, FindPlaces<Lattice>{lattice_, points, field_of_body, keys_.data(), order_.data(),
                                          reached_.data()});
    lattice_.slots = space.scan(reached_.data(), before_.data(), blocks());
    block_of_slot_.reserve(lattice_.slots);
    space.for_each(
        blocks(), NumberSlots{reached_.data(), before_.data(), slot_of_block_.data(), block_of_slot_.data()});
    lattice_.slot_of_block = slot_of_block_.data();
    lattice_.block_of_slot = block_of_slot_.data();
    space.sort(keys_, order_, n, static_cast<unsigned>(std::bit_width(blocks() * block_nodes - 1)));
    find_cells(space, n);
  }

  [[nodiscard]] std::size_t bytes() const {
    const auto sum = [](const auto&... arrays) { return (arrays.bytes() + ...); };
    return sum(keys_, order_, reached_, before_, block_of_slot_, cell_begin_, cell_of_ordered_, first_,
               slot_of_block_, cell_at_node_, nodes_of_cell_, nodes_, sums_);
  }

 private:
  [[nodiscard]] std::size_t blocks() const {
    return std::size_t{lattice_.blocks_of_field()} * lattice_.fields;
  }
  void find_cells(Space& space, std::size_t n) {
    nodes_.reserve(nodes());
    cell_at_node_.reserve(nodes());
    space.for_each(n, FlagCells{keys_.data(), first_.data()});
    const std::uint32_t cells = space.scan(first_.data(), before_.data(), n);
    lattice_.stencil_cells = cells;
    cell_begin_.reserve(cells + std::size_t{1});
    nodes_of_cell_.reserve(stencils());
    sums_.reserve(stencils());
    space.for_each(nodes(), Fill<std::int32_t>{cell_at_node_.data(), nowhere});
    lattice_.nodes = nodes_.data();
    lattice_.cell_at_node = cell_at_node_.data();
    lattice_.cell_begin = cell_begin_.data();
    lattice_.nodes_of_cell = nodes_of_cell_.data();
    lattice_.order = order_.data();
    space.for_each(
        n, NumberCells<Lattice>{lattice_, keys_.data(), first_.data(), before_.data(), cell_begin_.data(),
                                cell_at_node_.data(), cell_of_ordered_.data()});
    space.for_each(1, Fill<std::uint32_t>{cell_begin_.data() + cells, static_cast<std::uint32_t>(n)});
    space.for_each(stencils(), ListNodes<Lattice>{lattice_, keys_.data(), nodes_of_cell_.data()});
  }

  Lattice lattice_;
  Array<std::uint32_t> keys_, order_, reached_, before_, block_of_slot_, cell_begin_, cell_of_ordered_,
      first_;
  Array<std::int32_t> slot_of_block_, cell_at_node_, nodes_of_cell_;
  Array<Node> nodes_;
  Array<Node> sums_;  // of the stencil_nodes of each cell
};

}  // namespace whipple::device
