// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/device/lattice.hpp"
#include "src/device/points.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"

/// Particles and grid as a device keeps them, made from those of the host by plain loops.
namespace whipple::device {

/// Holds particles and grid of a device.
class OnDevice {
 public:
  Points points;
  SpaceLattice lattice;

  OnDevice(const grid::Geometry& geometry, const Particles& particles, std::span<const std::uint8_t> field,
           std::uint32_t fields) {
    copy_points(particles);
    lattice.cell_size = geometry.cell_size;
    lattice.lower = {geometry.lower[0], geometry.lower[1], geometry.lower[2]};
    lattice.fields = fields;
    for (std::size_t a = 0; a < 3; ++a) {
      lattice.cells[a] = geometry.cells[a];
      lattice.blocks[a] = geometry.blocks(static_cast<int>(a)) + 2;
    }
    find_blocks(field);
    find_cells(field);
  }
  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }

  /// Calls f(node of the device, node of the host) for all nodes of the device.
  template <class Function>
  void for_each_node(grid::BlockGrid& grid, Function&& f) {
    for (std::uint32_t slot = 0; slot < lattice.slots; ++slot) {
      const std::uint32_t first = slot * block_nodes, field = lattice.field_of(first);
      const Place at = lattice.place_of(first);
      constexpr int edge = SpaceLattice::block_edge;
      const std::int32_t found = grid.slot_of({at.x / edge, at.y / edge, at.z / edge});
      ASSERT_NE(found, grid::BlockGrid::no_slot);
      const auto of_host = static_cast<std::size_t>(found);
      ASSERT_TRUE(grid.fields(of_host).contains(field));
      for (std::uint32_t i = 0; i < block_nodes; ++i) f(nodes_[first + i], grid.nodes(of_host, field)[i]);
    }
  }
  /// Copies the sums of the host.
  void copy_sums(grid::BlockGrid& grid) {
    for_each_node(grid, [](Node& to, const grid::Node& from) {
      const Lanes a = from.sums.mass_and_momentum, b = from.sums.sound_and_force;
      to.n = {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
    });
  }
  /// Copies the motion of the host, with the masses of the sums, folded at planes, in the place of the heat.
  void copy_motion(grid::BlockGrid& grid) {
    const std::vector<double> mass = folded_masses();
    for_each_node(grid, [](Node& to, const grid::Node& from) {
      const Lanes a = from.motion.velocity_and_relaxation, b = from.motion.increment_and_heat;
      to.n = {a[0], a[1], a[2], a[3], b[0], b[1], b[2], 0.0};
    });
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (!lattice.is_image(lattice.place_of(i), lattice.field_of(i))) nodes_[i].set_heat(mass[i]);
    }
  }

 private:
  [[nodiscard]] std::vector<double> folded_masses() const {
    std::vector<double> mass;
    for (const Node& node : nodes_) mass.push_back(node.mass());
    for (int face = 0; face < 6; ++face) {
      for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Place at = lattice.place_of(i);
        const std::uint32_t field = lattice.field_of(i);
        if (!lattice.mirrors[static_cast<std::size_t>(face)].bonds(field) || lattice.inside_of(face, at) != 1)
          continue;
        const std::int32_t outside = lattice.node_at(field, lattice.mirrored(face, at));
        if (outside != nowhere) mass[i] += mass[static_cast<std::size_t>(outside)];
      }
    }
    return mass;
  }
  void copy_points(const Particles& q) {
    numbers_.assign(all_components * q.size(), 0.0);
    points = {.numbers = numbers_.data(), .stride = q.size(), .size = q.size()};
    for (std::size_t p = 0; p < q.size(); ++p) {
      points.set(position, p, {q.position[p][0], q.position[p][1], q.position[p][2]});
      points.at(volume, p) = q.volume[p];
      points.at(void_volume, p) = q.void_volume[p];
      const SymmetricTensor& e = q.extent[p];
      points.set(extent, p, {e.xx, e.yy, e.zz});
      points.set(extent + 3, p, {e.xy, e.yz, e.zx});
    }
  }
  [[nodiscard]] Place first_node(std::size_t p) const {
    return SpaceLattice::first_node(lattice.in_cells(points.vector(position, p)));
  }
  void find_blocks(std::span<const std::uint8_t> field) {
    slot_of_block_.assign(lattice.fields * lattice.blocks_of_field(), nowhere);
    for (std::size_t p = 0; p < points.size; ++p) {
      const Place first = first_node(p);
      for (int corner = 0; corner < 8; ++corner) {
        const auto shift = [&](int bit) { return (corner >> bit & 1) != 0 ? stencil_edge - 1 : 0; };
        slot_of_block_[lattice.block_at(field[p],
                                        {first.x + shift(0), first.y + shift(1), first.z + shift(2)})] = 0;
      }
    }
    for (std::uint32_t block = 0; block < slot_of_block_.size(); ++block) {
      if (slot_of_block_[block] == nowhere) continue;
      slot_of_block_[block] = static_cast<std::int32_t>(block_of_slot_.size());
      block_of_slot_.push_back(block);
    }
    nodes_.assign(block_of_slot_.size() * block_nodes, Node{});
    lattice.slots = static_cast<std::uint32_t>(block_of_slot_.size());
    lattice.slot_of_block = slot_of_block_.data();
    lattice.block_of_slot = block_of_slot_.data();
    lattice.nodes = nodes_.data();
  }
  void find_cells(std::span<const std::uint8_t> field) {
    std::vector<std::int32_t> node_of(points.size);
    for (std::size_t p = 0; p < points.size; ++p) {
      node_of[p] = lattice.node_at(field[p], first_node(p));
      order_.push_back(static_cast<std::uint32_t>(p));
    }
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t p) { return node_of[p]; });
    cell_at_node_.assign(nodes_.size(), nowhere);
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      std::int32_t& cell = cell_at_node_[static_cast<std::size_t>(node_of[order_[i]])];
      if (cell != nowhere) continue;
      cell = static_cast<std::int32_t>(cell_begin_.size());
      cell_begin_.push_back(i);
    }
    lattice.stencil_cells = static_cast<std::uint32_t>(cell_begin_.size());
    cell_begin_.push_back(static_cast<std::uint32_t>(order_.size()));
    lattice.cell_at_node = cell_at_node_.data();
    lattice.cell_begin = cell_begin_.data();
    lattice.order = order_.data();
  }

  std::vector<double> numbers_;
  std::vector<std::int32_t> slot_of_block_, cell_at_node_;
  std::vector<std::uint32_t> block_of_slot_, cell_begin_, order_;
  std::vector<Node> nodes_;
};

}  // namespace whipple::device
