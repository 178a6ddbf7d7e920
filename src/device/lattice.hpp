// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/core/base/triple.hpp"

/// The grid as a device keeps it. Every velocity field has nodes of its own, in blocks of 4 x 4 x 4, in two dimensions of
/// 8 x 8, where particles of the field reach; stencils are those of quadratic B-splines. Particles are listed by the first
/// node of their stencil: all with the same first node form a cell. Nodes are counted from the lower corner of the domain;
/// the nearest are -1 and cells + 1, beyond its faces.
namespace whipple::device {

constexpr std::uint32_t block_nodes = 64;
constexpr int stencil_edge = 3;  ///< nodes along a direction
constexpr std::int32_t nowhere = -1;

/// Selects the dimensions of the problem. In two dimensions all particles are in the plane z = lower, and so are all
/// nodes.
enum class Dimension : std::uint8_t {
  space,         ///< three dimensions
  plane_strain,  ///< a slice of a body that is uniform along z, 1 m thick
  axisymmetric,  ///< x along the axis, y the radius: a particle represents a ring
};

/// Holds the eight numbers of a node. Sums: mass, momentum (3), mass times sound speed, force (3). After the momentum
/// equation: velocity (3), relaxation beta, its increment (3), and the mass of the node; after contact, in place of the
/// mass, the heat of contact per mass (J/kg).
struct alignas(64) Node {
  std::array<double, 8> n;

  [[nodiscard]] WHIPPLE_POINT double mass() const { return n[0]; }  ///< of sums, kg
  [[nodiscard]] WHIPPLE_POINT Triple<double> momentum() const { return {n[1], n[2], n[3]}; }
  [[nodiscard]] WHIPPLE_POINT double sound() const { return n[4]; }
  [[nodiscard]] WHIPPLE_POINT Triple<double> force() const { return {n[5], n[6], n[7]}; }

  [[nodiscard]] WHIPPLE_POINT Triple<double> velocity() const { return {n[0], n[1], n[2]}; }
  [[nodiscard]] WHIPPLE_POINT double relaxation() const { return n[3]; }
  [[nodiscard]] WHIPPLE_POINT Triple<double> increment() const { return {n[4], n[5], n[6]}; }
  [[nodiscard]] WHIPPLE_POINT double mass_for_contact() const { return n[7]; }
  WHIPPLE_POINT void set_velocity(const Triple<double>& v) { n[0] = v.x, n[1] = v.y, n[2] = v.z; }
  WHIPPLE_POINT void set_relaxation(double beta) { n[3] = beta; }
  WHIPPLE_POINT void set_increment(const Triple<double>& d) { n[4] = d.x, n[5] = d.y, n[6] = d.z; }
  WHIPPLE_POINT void set_heat(double per_mass) { n[7] = per_mass; }
};

/// Position of a node.
struct Place {
  int x, y, z;
};

/// Describes a face of the domain at which material is one with its mirror image.
struct Mirror {
  bool active = false;
  bool reverses_all = false;  ///< no-slip: the image moves in the opposite direction in all components
  /// Fields that are one with their image, one bit each; others are in contact with it (contact/images.hpp).
  std::uint32_t fields = ~std::uint32_t{0};

  [[nodiscard]] WHIPPLE_POINT bool bonds(std::uint32_t field) const {
    return active && (fields >> field & 1U) != 0;
  }
};

/// Gives access to the grid of a step in the memory of a device.
/// @tparam in_plane  whether it is that of a section: one node along z, at which N = 1 with no slope
template <bool in_plane>
struct BasicLattice {
  static constexpr bool planar = in_plane;
  /// Edge of a block in nodes, along x and y and along z.
  static constexpr int block_edge = planar ? 8 : 4, block_edge_z = planar ? 1 : 4;
  static_assert(static_cast<std::uint32_t>(block_edge * block_edge * block_edge_z) == block_nodes);
  static constexpr int stencil_edge_z = planar ? 1 : stencil_edge;  ///< nodes along z
  static constexpr std::uint32_t stencil_nodes = stencil_edge * stencil_edge * stencil_edge_z;  ///< 27 or 9

  double cell_size = 0.0;  ///< m
  Triple<double> lower{};  ///< m
  std::array<int, 3> cells{};
  std::array<int, 3> blocks{};  ///< with a layer outside of each face that nodes reach
  std::array<Mirror, 6> mirrors{};
  double slope_smoothing = 0.0;  ///< of the slopes of the shape functions
  std::uint32_t fields = 1;
  bool has_rings = false;  ///< axisymmetry

  std::uint32_t slots = 0;                      ///< blocks with nodes, of all fields
  const std::int32_t* slot_of_block = nullptr;  ///< of block b of field f: f * blocks_of_field() + b
  const std::uint32_t* block_of_slot = nullptr;
  Node* nodes = nullptr;  ///< block_nodes for each slot

  std::uint32_t stencil_cells = 0;              ///< cells with particles
  const std::int32_t* cell_at_node = nullptr;   ///< number of the cell whose first node it is, or nowhere
  const std::uint32_t* cell_begin = nullptr;    ///< stencil_cells + 1 positions in `order`
  const std::int32_t* nodes_of_cell = nullptr;  ///< stencil_nodes for each cell, z fastest
  const std::uint32_t* order = nullptr;         ///< particles, cell by cell

  [[nodiscard]] WHIPPLE_POINT std::uint32_t blocks_of_field() const {
    return static_cast<std::uint32_t>(blocks[0] * blocks[1] * blocks[2]);
  }
  /// Returns the number of the block of a field that holds a node, whether or not it has a slot.
  [[nodiscard]] WHIPPLE_POINT std::uint32_t block_at(std::uint32_t field, const Place& at) const {
    const int x = (at.x + block_edge) / block_edge, y = (at.y + block_edge) / block_edge,
              z = planar ? 0 : (at.z + block_edge) / block_edge;
    return field * blocks_of_field() + static_cast<std::uint32_t>((x * blocks[1] + y) * blocks[2] + z);
  }
  /// Returns the place of a node in its block.
  [[nodiscard]] static WHIPPLE_POINT std::uint32_t inside(const Place& at) {
    constexpr int mask = block_edge - 1, mask_z = block_edge_z - 1;
    return static_cast<std::uint32_t>(((at.x & mask) * block_edge + (at.y & mask)) * block_edge_z +
                                      (at.z & mask_z));
  }
  /// Returns the number of a node of a field, or nowhere.
  [[nodiscard]] WHIPPLE_POINT std::int32_t node_at(std::uint32_t field, const Place& at) const {
    const std::int32_t slot = slot_of_block[block_at(field, at)];
    return slot == nowhere ? nowhere : slot * static_cast<int>(block_nodes) + static_cast<int>(inside(at));
  }
  [[nodiscard]] WHIPPLE_POINT std::uint32_t field_of(std::uint32_t node) const {
    return block_of_slot[node / block_nodes] / blocks_of_field();
  }
  [[nodiscard]] WHIPPLE_POINT Place place_of(std::uint32_t node) const {
    return place_in(block_of_slot[node / block_nodes], node % block_nodes);
  }
  /// Returns the place of a node from its block, of any field, and its place in that (`inside`).
  [[nodiscard]] WHIPPLE_POINT Place place_in(std::uint32_t block_of_any, std::uint32_t node) const {
    const int block = static_cast<int>(block_of_any % blocks_of_field()), i = static_cast<int>(node);
    return {(block / (blocks[1] * blocks[2]) - 1) * block_edge + i / (block_edge * block_edge_z),
            (block / blocks[2] % blocks[1] - 1) * block_edge + i / block_edge_z % block_edge,
            planar ? 0 : (block % blocks[2] - 1) * block_edge_z + i % block_edge_z};
  }
  /// Returns the place of node n of a stencil, counted from the first one.
  [[nodiscard]] static WHIPPLE_POINT Place in_stencil(int n) {
    return {n / (stencil_edge * stencil_edge_z), n / stencil_edge_z % stencil_edge, n % stencil_edge_z};
  }
  /// Returns the edge of a block along an axis, in nodes.
  [[nodiscard]] static WHIPPLE_POINT constexpr int edge_along(int axis) {
    return axis == 2 ? block_edge_z : block_edge;
  }
  /// Returns a position in cells from the lower corner.
  [[nodiscard]] WHIPPLE_POINT Triple<double> in_cells(const Triple<double>& x) const {
    return {(x.x - lower.x) / cell_size, (x.y - lower.y) / cell_size, (x.z - lower.z) / cell_size};
  }
  /// Returns the first node of the stencil of a position in cells.
  [[nodiscard]] static WHIPPLE_POINT Place first_node(const Triple<double>& in_cells) {
    return {static_cast<int>(std::floor(in_cells.x - 0.5)), static_cast<int>(std::floor(in_cells.y - 0.5)),
            planar ? 0 : static_cast<int>(std::floor(in_cells.z - 0.5))};
  }
  /// Returns the size of a cell in space or in the plane: m^3 or m^2.
  [[nodiscard]] WHIPPLE_POINT double cell_in_section() const {
    return planar ? cell_size * cell_size : cell_size * cell_size * cell_size;
  }
  [[nodiscard]] static WHIPPLE_POINT int along(const Place& at, int axis) {
    return axis == 0 ? at.x : axis == 1 ? at.y : at.z;
  }
  /// Returns whether a node of a field is beyond a plane at which the field is one with its image.
  [[nodiscard]] WHIPPLE_POINT bool is_image(const Place& at, std::uint32_t field) const {
    for (int face = 0; face < 6; ++face) {
      if (mirrors[static_cast<std::size_t>(face)].bonds(field) && inside_of(face, at) < 0) return true;
    }
    return false;
  }
  /// Returns how far a node is inside of a face of the domain, in cells.
  [[nodiscard]] WHIPPLE_POINT int inside_of(int face, const Place& at) const {
    const int place = along(at, face / 2);
    return face % 2 == 0 ? place : cells[static_cast<std::size_t>(face / 2)] - place;
  }
  /// Returns the mirror place of a node at a face.
  [[nodiscard]] WHIPPLE_POINT Place mirrored(int face, const Place& at) const {
    Place image = at;
    const int shift = (face % 2 == 0 ? -2 : 2) * inside_of(face, at);
    (face / 2 == 0 ? image.x : face / 2 == 1 ? image.y : image.z) += shift;
    return image;
  }
};
using SpaceLattice = BasicLattice<false>;
using SectionLattice = BasicLattice<true>;

}  // namespace whipple::device
