// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "src/core/base/tensor.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/base/words.hpp"
#include "src/grid/levels.hpp"

namespace whipple::grid {

/// Describes a block: cells along each direction, and the same number of nodes that it owns. Nodes are numbered with z
/// fastest.
struct BlockShape {
  int edge = 4;    ///< along x and y
  int edge_z = 4;  ///< along z

  [[nodiscard]] constexpr int along(std::size_t axis) const { return axis == 2 ? edge_z : edge; }
  [[nodiscard]] Lanes edges() const {
    return Lanes{static_cast<double>(edge), static_cast<double>(edge), static_cast<double>(edge_z), 1.0};
  }
  [[nodiscard]] constexpr int node(int x, int y, int z) const { return (x * edge + y) * edge_z + z; }
  /// Returns the position of a node in the block, by direction.
  [[nodiscard]] constexpr std::array<int, 3> place(int node) const {
    return {node / (edge * edge_z), node / edge_z % edge, node % edge_z};
  }
};
/// Returns 4 x 4 x 4 cells, or 8 x 8 x 1 in two dimensions: the same number of nodes.
constexpr BlockShape block_shape(bool planar) { return planar ? BlockShape{8, 1} : BlockShape{4, 4}; }
constexpr int nodes_per_block = 64;
static_assert(block_shape(true).node(7, 7, 0) == 63 && block_shape(false).node(3, 3, 3) == 63);

/// Maximum number of separate velocity fields (docs/theory/contact.md).
constexpr unsigned maximum_fields = 255;
/// Maximum number of fields with those into which cracks divide bodies: the sides of a crack are one word.
constexpr unsigned maximum_fields_with_cracks = 64;
/// Returns the number of direction sectors, each with a velocity field, into which the field of a body is divided at a
/// crack (docs/theory/cracks.md).
constexpr unsigned crack_sectors(bool planar) { return planar ? 8 : 14; }

/// Position of a block in units of the blocks of its level. Block (0, 0, 0) begins at the lower corner of the domain; one
/// layer of blocks is outside of every face, since kernels are wider than a cell and mirror planes need nodes beyond
/// them.
struct BlockCoordinate {
  std::array<std::int32_t, 3> along{};
  Level level = Level::fine;

  std::int32_t& operator[](std::size_t axis) { return along[axis]; }
  const std::int32_t& operator[](std::size_t axis) const { return along[axis]; }
  auto operator<=>(const BlockCoordinate&) const = default;
};

/// Selects the boundary condition at a face of the domain.
enum class Boundary : std::uint8_t {
  outflow,     ///< material leaves and is counted with its mass, momentum and energy
  symmetry,    ///< mirror plane: frictionless, material neither passes nor separates
  no_slip,     ///< no-slip wall
  separating,  ///< frictionless wall: transmits compression, no tension
  friction,    ///< separating wall with Coulomb friction
};
constexpr std::array<Word<Boundary>, 5> words(Boundary) {
  return {{{Boundary::outflow, "outflow"},
           {Boundary::symmetry, "symmetry"},
           {Boundary::no_slip, "no_slip"},
           {Boundary::separating, "separating"},
           {Boundary::friction, "friction"}}};
}
/// Returns whether material may part from a face that it touched: no field is continuous with its image there.
constexpr bool lets_part(Boundary kind) { return kind == Boundary::separating || kind == Boundary::friction; }

/// Selects the dimensions of the problem. In two dimensions all points are and remain in the plane z = lower.
enum class Dimension : std::uint8_t {
  space,         ///< three dimensions
  plane_strain,  ///< a slice of thickness `unit_depth` of a body that is uniform along z
  axisymmetric,  ///< x along the axis, y the radius: a point represents a ring
};
constexpr std::array<Word<Dimension>, 3> words(Dimension) {
  return {{{Dimension::space, "3d"},
           {Dimension::plane_strain, "plane_strain"},
           {Dimension::axisymmetric, "axisymmetric"}}};
}
constexpr double unit_depth = 1.0;  ///< along z in plane strain, m

/// Describes the background grid of the domain, or one level of it: node i of a direction is at lower + i * cell_size.
struct Geometry {
  Vector3 lower = Vector3::Zero();      ///< m
  std::array<std::int32_t, 3> cells{};  ///< number of cells
  double cell_size = 0.0;               ///< dx, m
  /// Faces in the order x_lower, x_upper, y_lower, y_upper, z_lower, z_upper.
  std::array<Boundary, 6> boundary{};
  double friction = 0.0;  ///< Coulomb coefficient of the walls of kind `friction`
  Dimension dimension = Dimension::space;
  Levels levels;  ///< where the cells are twice as large; their number along each axis is even then

  /// Returns the grid of a level, which fills the domain.
  [[nodiscard]] Geometry of_level(Level level) const {
    Geometry of = *this;
    if (level == Level::fine) return of;
    of.cell_size = 2.0 * cell_size;
    for (std::size_t a = 0; a < (is_planar() ? 2U : 3U); ++a) of.cells[a] = cells[a] / 2;
    return of;
  }
  /// Returns the fraction of the fine functions at a position.
  [[nodiscard]] Blend blend(const Vector3& position) const {
    return levels.are_two() ? levels.at(in_cells(position), cell_size) : Blend{};
  }
  /// Returns the level of the block that holds a position.
  [[nodiscard]] Level level_at(const Vector3& position) const {
    return levels.are_two() ? levels.level_at(in_cells(position)) : Level::fine;
  }
  /// Returns the edge of a cell whose functions have the second moment of those at a position, m (3).
  [[nodiscard]] double cell_size_at(const Blend& blend) const {
    if (!blend.is_mixed()) return blend.fine > 0.0 ? cell_size : 2.0 * cell_size;
    return cell_size * std::sqrt(blend.fine + 4.0 * (1.0 - blend.fine));
  }
  [[nodiscard]] double cell_size_at(const Vector3& position) const { return cell_size_at(blend(position)); }

  /// Returns a position in cells from the lower corner, directions in lanes. All computations of cell, block or stencil
  /// must use this function: different rounding would disagree about positions at the edge between two stencils.
  [[nodiscard]] Lanes in_cells(const Vector3& position) const {
    return (load_vector(position.data()) - load_vector(lower.data())) / cell_size;
  }
  [[nodiscard]] double upper(int axis) const { return lower[axis] + cells[axis] * cell_size; }
  [[nodiscard]] bool is_planar() const { return dimension != Dimension::space; }
  [[nodiscard]] bool is_axisymmetric() const { return dimension == Dimension::axisymmetric; }
  /// Returns the extent of a cell normal to the plane (m); in axisymmetry the circumference of the ring.
  [[nodiscard]] double depth(const Vector3& position) const {
    switch (dimension) {
      case Dimension::plane_strain:
        return unit_depth;
      case Dimension::axisymmetric:
        return 2.0 * std::numbers::pi * position[1];
      default:
        return cell_size;
    }
  }
  /// Returns the volume of a particle or, in two dimensions, its area in the plane.
  [[nodiscard]] double size_in_section(double volume, const Vector3& position) const {
    return is_planar() ? volume / depth(position) : volume;
  }
  /// Returns whether material continues beyond a face as its mirror image.
  [[nodiscard]] bool mirrors(std::size_t face) const {
    return boundary[face] == Boundary::symmetry || boundary[face] == Boundary::no_slip;
  }
  /// Returns the length that counts as round-off, m.
  [[nodiscard]] double tolerance() const { return 1e-6 * cell_size; }
  /// Returns whether a position is in the plane of a face.
  [[nodiscard]] bool is_in_plane(std::size_t face, const Vector3& position) const {
    const int axis = static_cast<int>(face / 2);
    const double plane = face % 2 == 0 ? lower[axis] : upper(axis);
    return std::abs(position[axis] - plane) < tolerance();
  }
  /// Returns whether a position is beyond an outflow face.
  [[nodiscard]] bool has_left(const Vector3& position) const {
    for (int axis = 0; axis < 3; ++axis) {
      const bool low = position[axis] < lower[axis], beyond = low || position[axis] > upper(axis);
      const std::size_t face = 2 * static_cast<std::size_t>(axis) + (low ? 0 : 1);
      if (beyond && boundary[face] == Boundary::outflow) return true;
    }
    return false;
  }
  /// Returns whether four positions are within the faces. Their twelve components are contiguous.
  [[nodiscard]] bool contains_four(const std::array<Lanes, 3>& positions) const {
    unsigned within = all_lanes;
    for (int j = 0; j < 3; ++j) {
      Lanes low, high;
      for (int k = 0; k < 4; ++k) {
        low[k] = lower[(4 * j + k) % 3];
        high[k] = upper((4 * j + k) % 3);
      }
      const Lanes x = positions[static_cast<std::size_t>(j)];
      within &= bits((x >= low) & (x <= high));
    }
    return within == all_lanes;
  }
  [[nodiscard]] BlockShape block() const { return block_shape(is_planar()); }
  /// Returns the number of blocks along an axis that contain cells of the domain (without the layer outside).
  [[nodiscard]] std::int32_t blocks(int axis) const {
    const int edge = block().along(static_cast<std::size_t>(axis));
    return (cells[axis] + edge - 1) / edge;
  }
};

}  // namespace whipple::grid
