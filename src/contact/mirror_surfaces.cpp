// SPDX-License-Identifier: BSD-3-Clause
// Extent of the material at the nodes near mirror planes (docs/theory/mpm.md, equation 3.7).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/contact/half_thickness.hpp"
#include "src/contact/mirror_contact.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/shape_weights.hpp"

namespace whipple::contact {
namespace {

using grid::BlockGrid;
using transfer::CarriesAffineField;
using transfer::count_z;
using transfer::Weights;
using transfer::weights_at;
using transfer::with_shape;

/// Distance (cells) from a plane beyond which points reach no node where contact with the image is possible, or are
/// behind other points that do.
constexpr double reach_of_points = 3.0;

/// Holds positions only; B-splines require nothing else.
struct Positions {
  std::span<const Vector3> position;
};

}  // namespace

template <class Shape>
void MirrorContact::extend(const Particles& particles, std::span<const Vector3> guests, BlockGrid& grid) {
  static constexpr grid::BlockShape block_shape = Shape::stencil.block();
  static constexpr grid::ReachMap map = grid::reach_map(block_shape.edge),
                                  map_z = grid::reach_map(block_shape.edge_z);
  constexpr int count = Shape::count;
  const grid::Geometry& geometry = grid.geometry();
  const Lanes upper_corner = {geometry.upper(0), geometry.upper(1), geometry.upper(2), 0.0};
  const Lanes lower_corner = {geometry.lower[0], geometry.lower[1], geometry.lower[2], 0.0};
  const auto is_near = [&](Lanes before_lower, Lanes before_upper, double cell_size) {
    return std::ranges::any_of(planes_, [&](const Plane& plane) {
      const Lanes& before = plane.of.face % 2 == 0 ? before_lower : before_upper;
      return before[plane.of.axis] > -reach_of_points * cell_size;
    });
  };
  /// Raises the extents of the nodes that the points of a slot and field reach.
  const auto extend_by = [&](std::size_t slot, unsigned field, BlockGrid::Points kind, const auto& points,
                             std::span<const std::uint32_t> members, auto&& thickness) {
    std::array<std::uint32_t, 27> first{};  // indices of the values of the 27 blocks
    for (std::size_t n = 0; n < 27; ++n) {
      const std::int32_t neighbour = grid.neighbours(slot)[n];
      if (neighbour == BlockGrid::no_slot) {
        first[n] = nowhere;
        continue;
      }
      const auto block = static_cast<std::size_t>(grid.nodes(static_cast<std::size_t>(neighbour), field) -
                                                  grid.all_nodes().data()) /
                         grid::nodes_per_block;
      first[n] = coupled_[block] != 0 ? first_of_block_[block] : nowhere;
    }
    if (std::ranges::all_of(first, [](std::uint32_t place) { return place == nowhere; })) return;
    const double cell_size = grid.cell_size(slot);
    for (const std::uint32_t p : members) {
      const Lanes x = load_vector(points.position[p].data());
      Lanes beyond_lower = lower_corner - x, beyond_upper = x - upper_corner;
      if (!is_near(beyond_lower, beyond_upper, cell_size)) continue;
      const Lanes half = thickness(p);
      beyond_lower += half;
      beyond_upper += half;
      const grid::PlaceInStencil& in_stencil = grid.places(kind)[p];
      const Weights<count> w = weights_at<Shape>(points, p, in_stencil, cell_size);
      const std::array<int, 3> from = in_stencil.first_node(Shape::stencil);
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
          for (std::size_t k = 0; k < count_z<Shape>; ++k) {
            if (!(w.weight[i][0] * w.weight[j][1] * w.weight[k][2] > 0.0)) continue;
            const auto at_x = static_cast<std::size_t>(from[0] + static_cast<int>(i) + 1);
            const auto at_y = static_cast<std::size_t>(from[1] + static_cast<int>(j) + 1);
            const auto at_z = static_cast<std::size_t>(from[2] + static_cast<int>(k) + 1);
            const std::uint32_t of_block = first[static_cast<std::size_t>(
                grid::neighbour_index(map.block[at_x], map.block[at_y], map_z.block[at_z]))];
            if (of_block == nowhere) continue;
            const int inside = block_shape.node(map.node[at_x], map.node[at_y], map_z.node[at_z]);
            Lanes* extent = &extent_.values[of_block + lanes_per_node * static_cast<std::size_t>(inside)];
            extent[0] = maximum(extent[0], beyond_lower);
            extent[1] = maximum(extent[1], beyond_upper);
          }
        }
      }
    }
  };
  grid.for_each_apart([&](std::size_t slot) {
    if (near_[slot] == 0) return;
    grid.for_each_field(
        BlockGrid::Points::particles, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
          extend_by(slot, field, BlockGrid::Points::particles, particles, members,
                    [&](std::uint32_t p) { return HalfThickness(geometry, particles, p).along_axes(); });
        });
    if constexpr (CarriesAffineField<Shape>) {  // off-grid points use B-splines only
      grid.for_each_field(BlockGrid::Points::guests, slot,
                          [&](std::span<const std::uint32_t> members, unsigned field) {
                            extend_by(slot, field, BlockGrid::Points::guests, Positions{guests}, members,
                                      [](std::uint32_t) { return Lanes{}; });
                          });
    }
  });
}

void MirrorContact::find_surfaces(transfer::ShapeFunction shape, const Particles& particles,
                                  std::span<const Vector3> guests, BlockGrid& grid, double dt) {
  shares_known_ = false;
  dt_ = dt;
  lay_out(grid);
  if (planes_.empty()) return;
  std::ranges::fill(extent_.values, broadcast(-std::numeric_limits<double>::infinity()));
  with_shape(shape, [&]<class Shape>(Shape) { extend<Shape>(particles, guests, grid); });
  if (!grid.is_shared()) return;
  grid.maximum_to_owners(extent_);
  grid.borrow_from_owners(extent_);
}

}  // namespace whipple::contact
