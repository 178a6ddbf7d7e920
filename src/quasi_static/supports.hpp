// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

/// Load steps of material at rest, with implicit equilibrium on the grid (docs/theory/quasi_static.md).
namespace whipple::quasi_static {

/// Describes a node that a point reaches: its number among the active nodes, shape function N and slopes (1/m).
struct Reached {
  std::uint32_t node;
  double n;
  Vector3 gradient;
};

/// Holds the nodes that points reach, those of point p at begin[p] to begin[p + 1].
struct Reach {
  std::vector<std::size_t> begin = {0};
  std::vector<Reached> reached;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const Reached> of(std::size_t p) const {
    return std::span(reached).subspan(begin[p], begin[p + 1] - begin[p]);
  }
};

/// Describes the nodes of a load step and the points that reach them.
struct Supports {
  grid::Dimension dimension = grid::Dimension::space;
  int most_along = 0;                               ///< nodes along a direction that a point connects
  std::vector<std::uint32_t> grid_node;             ///< of each active node: its index in the grid, ascending
  std::vector<std::array<std::int32_t, 3>> places;  ///< of each active node, in cells
  Reach particles;                                  ///< of every particle
  std::vector<double> per_radius;  ///< 1/r of the ring of every particle, 1/m; empty: no rings
  /// Integration points of cells at the border of the material, which hold nodes of small support (eq. 9).
  Reach border;
  std::vector<double> border_volume;           ///< of each of these points, m^3
  std::vector<std::uint32_t> border_particle;  ///< a particle of its cell

  [[nodiscard]] std::size_t nodes() const { return grid_node.size(); }
  /// Returns the number of components of a displacement.
  [[nodiscard]] int components() const { return dimension == grid::Dimension::space ? 3 : 2; }
  /// Returns the number of components of the deformation that displacements change.
  [[nodiscard]] int strains() const {
    if (dimension == grid::Dimension::space) return 9;
    return dimension == grid::Dimension::axisymmetric ? 5 : 4;
  }
};

/// Finds the nodes that the particles reach at their places of the last binning.
/// @param with_border  whether points at the border of the material are asked for
Supports find_supports(const transfer::ShapeFunctions& functions, const Particles& particles,
                       grid::BlockGrid& grid, bool with_border);

}  // namespace whipple::quasi_static
