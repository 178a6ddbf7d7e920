// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/plain_nodes.hpp"

#include <algorithm>

namespace whipple::transfer::plain {

AxisWeights<most_nodes> along_axis(ShapeFunction kind, double from_first, double half_size,
                                   const Cells& cells) {
  return with_shape(kind, [&]<class Shape>(Shape) {
    const auto weights = [&] {
      if constexpr (Sized<Shape>) return Shape::weights(from_first, half_size, cells);
      if constexpr (!Sized<Shape>) return Shape::weights(from_first, cells);
    }();
    AxisWeights<most_nodes> all{};
    std::ranges::copy(weights.weight, all.weight.begin());
    std::ranges::copy(weights.derivative, all.derivative.begin());
    std::ranges::copy(weights.distance, all.distance.begin());
    return all;
  });
}

AxisWeights<most_nodes> across_plane() { return {.weight = {1.0}, .derivative = {}, .distance = {}}; }

NodesAround::NodesAround(grid::BlockGrid& grid, std::size_t slot, unsigned field, grid::Stencil stencil)
    : grid_(grid),
      slot_(slot),
      field_(field),
      block_(stencil.block()),
      map_(grid::reach_map(block_.edge)),
      map_z_(grid::reach_map(block_.edge_z)) {}

grid::Node& NodesAround::at(int x, int y, int z) const {
  // The maps begin one node before the block.
  const auto ux = static_cast<std::size_t>(x + 1), uy = static_cast<std::size_t>(y + 1),
             uz = static_cast<std::size_t>(z + 1);
  const std::int32_t owner = grid_.neighbours(slot_)[static_cast<std::size_t>(
      grid::neighbour_index(map_.block[ux], map_.block[uy], map_z_.block[uz]))];
  return grid_.nodes(static_cast<std::size_t>(owner),
                     field_)[block_.node(map_.node[ux], map_.node[uy], map_z_.node[uz])];
}

}  // namespace whipple::transfer::plain
