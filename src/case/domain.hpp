// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "src/case/refinement.hpp"
#include "src/case/section.hpp"
#include "src/case/shapes/axis.hpp"
#include "src/grid/geometry.hpp"

namespace whipple::cases {

/// Holds the boundary condition at each face of the domain.
struct Faces {
  grid::Boundary x_lower{}, x_upper{}, y_lower{}, y_upper{}, z_lower{}, z_upper{};

  static ParameterTable<Faces> parameters();
  /// Returns the faces in the order of grid::Geometry::boundary.
  [[nodiscard]] std::array<grid::Boundary, 6> in_order() const {
    return {x_lower, x_upper, y_lower, y_upper, z_lower, z_upper};
  }
  [[nodiscard]] bool any(grid::Boundary kind) const;
  /// Returns the faces in the directions of a section whose first direction is `first` in space.
  [[nodiscard]] Faces in_section(std::size_t first) const;
};

/// Describes the simulated region and its cells.
struct Domain {
  Vector3 lower = Vector3::Zero();  ///< m
  Vector3 upper = Vector3::Zero();  ///< m
  double cell_size = 0.0;           ///< of the finest cells, m
  double friction =
      std::numeric_limits<double>::infinity();  ///< of faces of kind `friction`; infinite: not given
  grid::Dimension dimension = grid::Dimension::space;
  /// Selects the spatial direction that becomes the first one of a section, as read from `axis`; after reading, the
  /// case uses the directions of the section.
  Axis axis = Axis::x;
  Faces boundary;
  std::vector<Refinement> refinement;  ///< where the cells have that size; empty: everywhere

  static constexpr bool required = true;
  static ParameterTable<Domain> parameters();
  static std::span<const Section<Domain>> sections();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the edge of the largest cells, m.
  [[nodiscard]] double coarse_cell_size() const { return refinement.empty() ? cell_size : 2.0 * cell_size; }
  [[nodiscard]] bool is_planar() const { return dimension != grid::Dimension::space; }
  /// Returns the grid of whole cells, without its levels; in two dimensions it has one cell along z, starting at z = 0. Walls coincide with
  /// cell faces; an outflow face at an upper end is moved outwards to one. An axis for which `check` finds a fault may
  /// have no cells.
  [[nodiscard]] grid::Geometry geometry() const;
};

}  // namespace whipple::cases
