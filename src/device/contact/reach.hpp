// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/device/lattice.hpp"
#include "src/device/points.hpp"

/// Particles that reach a node, with their images at mirror planes.
namespace whipple::device {

/// Returns whether a node is in the blocks of the lattice.
template <class Lattice>
[[nodiscard]] WHIPPLE_POINT inline bool is_in_blocks(const Lattice& lattice, const Place& at) {
  constexpr int edge = Lattice::block_edge;
  return at.x >= -edge && at.y >= -edge && (Lattice::planar || at.z >= -edge) &&
         at.x < (lattice.blocks[0] - 1) * edge && at.y < (lattice.blocks[1] - 1) * edge &&
         (Lattice::planar || at.z < (lattice.blocks[2] - 1) * edge);
}

/// Describes a particle, or its image beyond a mirror plane, relative to a node that it reaches.
struct ReachedFrom {
  double weight;            ///< N
  Triple<double> gradient;  ///< of N, 1/m: slopes of contact are not smoothed
  Triple<double> distance;  ///< from the node to the particle or its image, m
  Triple<double> sign;      ///< of each component under the reflections that lead to the image
};

/// Describes the nodes along an axis whose particles reach a node: itself, and beyond planes its mirror nodes.
struct AxisOfReach {
  int place, cells;
  bool lower, upper;  ///< whether there are images across the plane

  static constexpr int sources = 3;
  template <class Lattice>
  WHIPPLE_POINT AxisOfReach(const Lattice& lattice, std::uint32_t field, int axis, int at)
      : place(at),
        cells(lattice.cells[static_cast<std::size_t>(axis)]),
        // Stencils of particles in the domain reach one node beyond a plane.
        lower(at == 1 && lattice.mirrors[2 * static_cast<std::size_t>(axis)].bonds(field)),
        upper(at == cells - 1 && lattice.mirrors[2 * static_cast<std::size_t>(axis) + 1].bonds(field)) {}
  [[nodiscard]] WHIPPLE_POINT bool has(int source) const {
    return source == 0 || (source == 1 ? lower : upper);
  }
  [[nodiscard]] WHIPPLE_POINT int at(int source) const {
    return source == 0 ? place : source == 1 ? -place : 2 * cells - place;
  }
  [[nodiscard]] WHIPPLE_POINT static double sign(int source) { return source == 0 ? 1.0 : -1.0; }
};

/// Holds weight and derivative (per cell) of a node along an axis; at first, those of the one node across a section.
struct AxisWeight {
  double weight = 1.0, derivative = 0.0;

  AxisWeight() = default;
  /// @param g  position of the particle in cells from the first node of its stencil
  /// @param k  number of the node in the stencil
  WHIPPLE_POINT AxisWeight(double g, int k) {
    const double y = g - 1.0, t = k == 0 ? 1.5 - g : g - 0.5;
    weight = k == 1 ? 0.75 - y * y : 0.5 * t * t;
    derivative = k == 1 ? -2.0 * y : k == 0 ? y - 0.5 : y + 0.5;
  }
};

/// Calls visit(particle, ReachedFrom) for the particles of a field that reach a place, or whose images do.
/// @param from  place that the particles themselves reach
/// @param sign  of the components under the reflections
template <class Lattice, class Visit>
WHIPPLE_POINT inline void for_each_point_from(const Lattice& lattice, const Points& points,
                                              std::uint32_t field, const Place& from,
                                              const Triple<double>& sign, const Visit& visit) {
  const double size = lattice.cell_size, per_cell = 1.0 / size;
  for (int n = 0; n < static_cast<int>(Lattice::stencil_nodes); ++n) {
    const Place k = Lattice::in_stencil(n);
    const Place first = {from.x - k.x, from.y - k.y, from.z - k.z};
    if (!is_in_blocks(lattice, first)) continue;
    const std::int32_t node = lattice.node_at(field, first);
    if (node == nowhere) continue;
    const std::int32_t cell = lattice.cell_at_node[node];
    if (cell == nowhere) continue;
    for (std::uint32_t j = lattice.cell_begin[cell]; j < lattice.cell_begin[cell + 1]; ++j) {
      const std::uint32_t p = lattice.order[j];
      const Triple<double> x = lattice.in_cells(points.vector(position, p));
      const Triple<double> g = {x.x - first.x, x.y - first.y, x.z - first.z};
      const AxisWeight wx(g.x, k.x), wy(g.y, k.y);
      AxisWeight wz;
      if constexpr (!Lattice::planar) wz = AxisWeight(g.z, k.z);
      const double weight = wx.weight * wy.weight * wz.weight;
      if (!(weight > 0.0)) continue;
      visit(p, ReachedFrom{.weight = weight,
                           .gradient = {sign.x * (per_cell * wx.derivative * wy.weight * wz.weight),
                                        sign.y * (wx.weight * (per_cell * wy.derivative) * wz.weight),
                                        sign.z * (wx.weight * wy.weight * (per_cell * wz.derivative))},
                           .distance = {sign.x * ((g.x - k.x) * size), sign.y * ((g.y - k.y) * size),
                                        sign.z * ((g.z - k.z) * size)},
                           .sign = sign});
    }
  }
}

/// Calls visit(particle, ReachedFrom) for all particles of a field that reach a node of it, and for the images of those
/// across planes at which the field is one with its image, always in the same order.
template <class Lattice, class Visit>
WHIPPLE_POINT inline void for_each_point_at(const Lattice& lattice, const Points& points, std::uint32_t field,
                                            const Place& node, const Visit& visit) {
  const AxisOfReach along_x(lattice, field, 0, node.x), along_y(lattice, field, 1, node.y),
      along_z(lattice, field, 2, node.z);
  constexpr int n = AxisOfReach::sources, n_z = Lattice::planar ? 1 : n;
  for (int source = 0; source < n * n * n_z; ++source) {
    const int sx = source / (n * n_z), sy = source / n_z % n, sz = source % n_z;
    if (!along_x.has(sx) || !along_y.has(sy) || !along_z.has(sz)) continue;
    for_each_point_from(lattice, points, field, {along_x.at(sx), along_y.at(sy), along_z.at(sz)},
                        {AxisOfReach::sign(sx), AxisOfReach::sign(sy), AxisOfReach::sign(sz)}, visit);
  }
}

/// Returns 0 for the components along the normals of the mirror planes on which a node is located, where the
/// contributions of particles and images cancel, and 1 for the others.
template <class Lattice>
[[nodiscard]] WHIPPLE_POINT inline Triple<double> off_planes(const Lattice& lattice, std::uint32_t field,
                                                             const Place& node) {
  const auto along = [&](int axis) {
    for (int face = 2 * axis; face < 2 * axis + 2; ++face) {
      if (lattice.mirrors[static_cast<std::size_t>(face)].bonds(field) && lattice.inside_of(face, node) == 0)
        return 0.0;
    }
    return 1.0;
  };
  return {along(0), along(1), along(2)};
}

}  // namespace whipple::device
