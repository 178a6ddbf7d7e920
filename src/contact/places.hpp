// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/contact/place.hpp"
#include "src/contact/surface_points.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_weights.hpp"
#include "src/transfer/shapes.hpp"

/// Nodes of contact slots that points reach, mirror planes included.
namespace whipple::contact {

/// Enumerates the relevant nodes that the points of one body in a block reach. A node beyond a mirror plane is replaced
/// by its image, which the image of the point reaches.
class Reach {
 public:
  /// @param block       block of the points
  /// @param neighbours  slots of the 27 blocks around it, as far as they are included
  /// @param body        undivided field of the body
  /// @param see         see(slot): returns a SeenSlot
  template <class See>
  Reach(const grid::BlockGrid& grid, const grid::BlockCoordinate& block,
        const std::array<std::int32_t, 27>& neighbours, unsigned body, See&& see)
      : geometry_(grid.geometry(block)),
        block_(block),
        axes_{folded(grid, 0, block, body), folded(grid, 1, block, body), folded(grid, 2, block, body)} {
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      if (neighbours[n] == grid::BlockGrid::no_slot) continue;
      slots_[n] = see(static_cast<std::size_t>(neighbours[n]));
      any_ = any_ || slots_[n].nodes != 0;
    }
  }
  [[nodiscard]] bool any() const { return any_; }

  /// Calls f(place) for the relevant nodes that point `p` reaches.
  /// @param at_point  at_point(p) returns f; called only if there are such nodes
  template <class Shape, class Points, class AtPoint>
  void for_each_place(const Points& points, std::uint32_t p, AtPoint&& at_point) const {
    constexpr int count = Shape::count;
    constexpr grid::BlockShape shape = Shape::stencil.block();
    const grid::PlaceInStencil in_stencil = grid::StencilPlaces(Shape::stencil)(grid::position_in_block(
        geometry_.in_cells(points.position[p]), grid::corner_of(block_, shape), shape.edges()));
    const std::array<int, 3> node = in_stencil.first_node(Shape::stencil);
    const std::array<std::size_t, 3> first = {static_cast<std::size_t>(node[0] + 1),
                                              static_cast<std::size_t>(node[1] + 1),
                                              static_cast<std::size_t>(node[2] + 1)};
    std::array<std::uint64_t, 27> reached{};
    constexpr auto along_z = static_cast<int>(transfer::count_z<Shape>);
    if (!reaches(first, {count, count, along_z}, reached)) return;
    const transfer::Weights<count> w =
        transfer::weights_at<Shape>(points, p, in_stencil, geometry_.cell_size);
    const auto f = at_point(p);
    for (std::size_t i = 0; i < count; ++i) {
      const Folded& x = axes_[0][first[0] + i];
      for (std::size_t j = 0; j < count; ++j) {
        const Folded& y = axes_[1][first[1] + j];
        for (std::size_t k = 0; k < along_z; ++k) {
          const Folded& z = axes_[2][first[2] + k];
          const auto n = static_cast<std::size_t>(grid::neighbour_index(x.block, y.block, z.block));
          const std::uint64_t bit = x.nodes & y.nodes & z.nodes;
          if ((reached[n] & bit) == 0) continue;
          const double weight = w.weight[i][0] * w.weight[j][1] * w.weight[k][2];
          if (!(weight > 0.0)) continue;
          const Vector3 sign(x.sign, y.sign, z.sign);
          const Vector3 gradient(w.derivative[i][0] * w.weight[j][1] * w.weight[k][2],
                                 w.weight[i][0] * w.derivative[j][1] * w.weight[k][2],
                                 w.weight[i][0] * w.weight[j][1] * w.derivative[k][2]);
          const Vector3 distance(w.distance[i][0], w.distance[j][1], w.distance[k][2]);
          f(Place{.contact_slot = slots_[n].contact_slot,
                  .bodies = slots_[n].bodies,
                  .body = slots_[n].body,
                  .node = static_cast<std::size_t>(std::countr_zero(bit)),
                  .weight = weight,
                  .gradient = sign.cwiseProduct(gradient),
                  .distance = -sign.cwiseProduct(distance),
                  .off_plane = Vector3(x.off_plane, y.off_plane, z.off_plane),
                  .sign = sign});
        }
      }
    }
  }

 private:
  static constexpr std::size_t places = grid::longest_reach_edge;  // along a direction, from -1

  /// Describes one node position along a direction, folded at the mirror planes.
  struct Folded {
    std::uint64_t nodes = 0;  // nodes of a block with that number along the direction
    double sign = 1.0;        // -1 beyond a plane
    double off_plane = 1.0;   // 0 on a plane, where the contributions of point and image cancel
    int block = 0;            // 0 to 2
  };
  using FoldedAxis = std::array<Folded, places>;

  /// One bit per node of a block, by its number along each axis.
  using LayersOfNodes = std::array<std::array<std::uint64_t, grid::block_shape(true).edge>, 3>;
  static constexpr LayersOfNodes layers_of_nodes(bool planar) {
    LayersOfNodes layers{};
    for (int node = 0; node < grid::nodes_per_block; ++node) {
      const std::array<int, 3> place = grid::block_shape(planar).place(node);
      for (std::size_t a = 0; a < 3; ++a) {
        layers[a][static_cast<std::size_t>(place[a])] |= std::uint64_t{1} << node;
      }
    }
    return layers;
  }

  static FoldedAxis folded(const grid::BlockGrid& grid, std::size_t axis, const grid::BlockCoordinate& of,
                           unsigned body) {
    static constexpr std::array<LayersOfNodes, 2> layers_by_shape = {layers_of_nodes(false),
                                                                     layers_of_nodes(true)};
    const auto& layers = layers_by_shape[grid.geometry().is_planar() ? 1 : 0][axis];
    static constexpr grid::ReachMap of_four = grid::reach_map(4), of_eight = grid::reach_map(8),
                                    of_one = grid::reach_map(1);
    const int edge = grid.block_shape().along(axis), cells = grid.geometry(of).cells[axis], block = of[axis];
    const grid::ReachMap& map = edge == 4 ? of_four : edge == 8 ? of_eight : of_one;
    const bool lower = grid.is_bonded_at(2 * axis, body), upper = grid.is_bonded_at(2 * axis + 1, body);
    FoldedAxis all;
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid::reach_edge(edge)); ++n) {
      int place = block * edge + static_cast<int>(n) - 1;
      const auto reflect = [&](int at) {
        place = 2 * at - place;
        all[n].sign = -all[n].sign;
      };
      if (lower && place < 0) reflect(0);
      if (upper && place > cells) reflect(cells);
      if ((lower && place == 0) || (upper && place == cells)) all[n].off_plane = 0.0;
      const int from_corner = place - block * edge + 1;
      // Outside the reach of all stencils
      if (from_corner < 0 || from_corner >= grid::reach_edge(edge)) continue;
      const auto m = static_cast<std::size_t>(from_corner);
      all[n].block = map.block[m];
      all[n].nodes = layers[static_cast<std::size_t>(map.node[m])];
    }
    return all;
  }

  /// Finds the relevant nodes in the stencil for each of the 27 blocks; returns whether there are any.
  [[nodiscard]] WHIPPLE_INLINE bool reaches(const std::array<std::size_t, 3>& first,
                                            const std::array<int, 3>& count,
                                            std::array<std::uint64_t, 27>& reached) const {
    std::array<std::array<std::uint64_t, 3>, 3> layers{};
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t n = first[a]; n < first[a] + static_cast<std::size_t>(count[a]); ++n) {
        layers[a][static_cast<std::size_t>(axes_[a][n].block)] |= axes_[a][n].nodes;
      }
    }
    std::uint64_t some = 0;
    for (int x = 0; x < 3; ++x) {
      const std::uint64_t in_x = layers[0][static_cast<std::size_t>(x)];
      if (in_x == 0) continue;
      for (int y = 0; y < 3; ++y) {
        const std::uint64_t in_xy = in_x & layers[1][static_cast<std::size_t>(y)];
        if (in_xy == 0) continue;
        for (int z = 0; z < 3; ++z) {
          const auto n = static_cast<std::size_t>(grid::neighbour_index(x, y, z));
          reached[n] = in_xy & layers[2][static_cast<std::size_t>(z)] & slots_[n].nodes;
          some |= reached[n];
        }
      }
    }
    return some != 0;
  }

  const grid::Geometry& geometry_;  // of the level of the block
  grid::BlockCoordinate block_;
  std::array<FoldedAxis, 3> axes_;
  std::array<SeenSlot, 27> slots_{};  // of the 27 blocks
  bool any_ = false;
};

/// Calls at_point(p) for all particles p that reach relevant nodes, and the function that it returns for the place of
/// each of those nodes. No two concurrent calls for one node.
template <class Shape, class AtPoint>
void for_each_place(const Particles& particles, const grid::BlockGrid& grid, const NodesThatMatter& matter,
                    AtPoint&& at_point) {
  grid.for_each_apart([&](std::size_t slot) {
    if (!grid.meets_contact(slot)) return;
    const bool reaches_some = std::ranges::any_of(grid.neighbours(slot), [&](std::int32_t near) {
      if (near == grid::BlockGrid::no_slot) return false;
      const std::int32_t number = grid.contact_number(static_cast<std::size_t>(near));
      return number != grid::BlockGrid::no_slot && matter[static_cast<std::size_t>(number)] != 0;
    });
    if (!reaches_some) return;
    grid.for_each_field(grid::BlockGrid::Points::particles, slot,
                        [&](std::span<const std::uint32_t> members, unsigned field) {
                          const unsigned body = grid.whole(field);
                          const Reach reach(
                              grid, grid.coordinate(slot), grid.neighbours(slot), body,
                              [&](std::size_t near) { return seen_at_contact(grid, near, body, matter); });
                          if (!reach.any()) return;
                          for (const std::uint32_t p : members) {
                            reach.for_each_place<Shape>(particles, p, at_point);
                          }
                        });
  });
}

/// Visits the surface points of elements in the same way; these use B-splines only.
template <class Shape, class AtPoint>
void for_each_place(const PlacedPoints& placed, const grid::BlockGrid& grid, const NodesThatMatter& matter,
                    AtPoint&& at_point) {
  if constexpr (transfer::CarriesAffineField<Shape>) {
    for (const std::vector<std::uint32_t>& colour : placed.colours) {
      parallel::for_each_uneven(colour.size(), [&](std::size_t c) {
        const PlacedPoints::Block& block = placed.blocks[colour[c]];
        for (const std::uint32_t p : block.points) {
          const unsigned body = placed.points->field[p];
          const Reach reach(grid, block.coordinate, block.slots, body,
                            [&](std::size_t near) { return seen_at_contact(grid, near, body, matter); });
          if (!reach.any()) continue;
          reach.for_each_place<Shape>(*placed.points, p, at_point);
        }
      });
    }
  }
}

}  // namespace whipple::contact
