// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/grid/block_grid.hpp"
#include "src/transfer/shape_weights.hpp"

/// The nodes of a point as the plain loops see them, with the shape function chosen at run time.
namespace whipple::transfer::plain {

/// Shape function N of a node at a point, its slopes S (1/m) and the vector r
/// from the point to the node (m).
struct AtNode {
  double n;
  Vector3 gradient, r;
};

/// A shape function as numbers: the loops are the same for all.
struct Functions {
  ShapeFunction kind;
  grid::Stencil stencil;
  std::size_t count, count_z;  ///< nodes in x and y, and along z
  double second_moment;        ///< sum of N r r^T along one direction, in dx^2; 0: the
                               ///< functions carry no affine field
};
template <class Shape>
constexpr Functions functions() {
  double second_moment = 0.0;
  if constexpr (CarriesAffineField<Shape>) second_moment = Shape::second_moment;
  return {Shape::kind, Shape::stencil, static_cast<std::size_t>(Shape::count), count_z<Shape>, second_moment};
}

constexpr int most_nodes = 4;  ///< that a point reaches along a direction
/// Returns N, S and r of the nodes along a direction, `Functions::count` of
/// them.
/// @param from_first  position in cells from the first node
/// @param half_size   of the particle's domain, in cells; only GIMP uses it
AxisWeights<most_nodes> along_axis(ShapeFunction kind, double from_first, double half_size,
                                   const Cells& cells);
/// Returns those of the one node that a plane has along z.
AxisWeights<most_nodes> across_plane();

/// Nodes of a block and of those around it, for points of one velocity field.
class NodesAround {
 public:
  NodesAround(grid::BlockGrid& grid, std::size_t slot, unsigned field, grid::Stencil stencil);
  /// Returns a node by its place, counted from the lower corner of the block.
  [[nodiscard]] grid::Node& at(int x, int y, int z) const;

 private:
  grid::BlockGrid& grid_;
  std::size_t slot_;
  unsigned field_;
  grid::BlockShape block_;
  grid::ReachMap map_, map_z_;
};

/// Calls f(node, AtNode) for the nodes of a point.
template <class Points, class Function>
void for_each_node(const Functions& functions, const Points& points, std::size_t p,
                   const grid::PlaceInStencil& place, const Cells& cells, const NodesAround& nodes,
                   Function&& f) {
  Vector3 half = Vector3::Zero();
  if constexpr (requires { points.extent; }) {
    if (!points.extent.empty()) half = half_sizes(points.extent[p], cells.size);
  }
  const auto along = [&](std::size_t direction) {
    if (direction == 2 && functions.stencil.planar) return across_plane();
    return along_axis(functions.kind, place.from_first(direction), half[static_cast<Eigen::Index>(direction)],
                      cells.along(direction));
  };
  const auto x = along(0), y = along(1), z = along(2);
  const std::array<int, 3> first = place.first_node(functions.stencil);
  for (std::size_t i = 0; i < functions.count; ++i) {
    for (std::size_t j = 0; j < functions.count; ++j) {
      for (std::size_t k = 0; k < functions.count_z; ++k) {
        f(nodes.at(first[0] + static_cast<int>(i), first[1] + static_cast<int>(j),
                   first[2] + static_cast<int>(k)),
          AtNode{.n = x.weight[i] * y.weight[j] * z.weight[k],
                 .gradient = {x.derivative[i] * y.weight[j] * z.weight[k],
                              x.weight[i] * y.derivative[j] * z.weight[k],
                              x.weight[i] * y.weight[j] * z.derivative[k]},
                 .r = {x.distance[i], y.distance[j], z.distance[k]}});
      }
    }
  }
}

}  // namespace whipple::transfer::plain
