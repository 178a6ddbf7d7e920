// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/device/nodes.hpp"
#include "src/device/reduction.hpp"
#include "src/device/stencil.hpp"

/// Fill of the cells by material of all fields (transfer::fill_of_cells): material under pressure in cells that it does
/// not fill lies beside a void that the grid does not see.
namespace whipple::device {

/// Sums the volumes of the particles of a cell, with their voids, at one of its nodes, in volumes of a cell.
template <class Lattice>
struct SumVolumes {
  Lattice lattice;
  Points points;
  Node* sums;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const double per_cell = 1.0 / lattice.cell_in_section();
    sums[i] = sum_of_cell(lattice, i, [&](std::uint32_t p, const Place& n, Node& sum) {
      const double weight = seen(weights_at(lattice, points.vector(position, p), 0.0), n).n;
      sum.n[0] += weight * per_cell * size_in_section<Lattice::planar>(points, p);
    });
  }
};

/// Adds at the nodes next to a reflecting face what is beyond it; the image brings as much again to the nodes on it.
template <class Lattice>
struct FoldVolumes {
  Lattice lattice;
  int face;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const Place at = lattice.place_of(node);
    const int inside = lattice.inside_of(face, at);
    if (inside == 0) lattice.nodes[node].n[0] *= 2.0;
    if (inside != 1) return;
    const std::int32_t outside = lattice.node_at(lattice.field_of(node), lattice.mirrored(face, at));
    if (outside != nowhere) lattice.nodes[node].n[0] += lattice.nodes[outside].n[0];
  }
};

/// Sets n[1] to the sum of all fields at the place of a node, or at that of its image.
template <class Lattice>
struct JoinVolumes {
  Lattice lattice;
  std::uint32_t reflecting;  ///< faces, one bit each

  WHIPPLE_POINT void operator()(std::size_t i) const {
    Place at = lattice.place_of(static_cast<std::uint32_t>(i));
    for (int face = 0; face < 6; ++face) {
      if ((reflecting >> face & 1U) != 0 && lattice.inside_of(face, at) < 0) at = lattice.mirrored(face, at);
    }
    double sum = 0.0;
    for (std::uint32_t field = 0; field < lattice.fields; ++field) {
      const std::int32_t node = lattice.node_at(field, at);
      if (node != nowhere) sum += lattice.nodes[node].n[0];
    }
    lattice.nodes[i].n[1] = sum;
  }
};

/// Sums the mass (kg) of intact particles under high pressure in cells that are not filled.
template <class Lattice>
struct MassBesideVoids {
  using Result = Reduction<1, 0>;
  Lattice lattice;
  Points points;
  const std::uint32_t* cell_of_ordered;
  double strong;  ///< pressure over rho c^2 above which it is high
  double filled;  ///< fraction of the cells that material under pressure should fill

  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const std::uint32_t p = lattice.order[i];
    const double c = points.at(sound_speed, p), m = points.at(mass, p);
    if (points.at(failed, p) != 0.0 || !(points.at(pressure, p) * points.at(volume, p) > strong * m * c * c))
      return;
    const std::int32_t* const nodes =
        lattice.nodes_of_cell + static_cast<std::size_t>(cell_of_ordered[i]) * Lattice::stencil_nodes;
    double fill = 0.0;
    for_each_seen(weights_at(lattice, points.vector(position, p), 0.0),
                  [&](int n, const SeenNode& at) { fill += at.n * lattice.nodes[nodes[n]].n[1]; });
    if (fill < filled) result.sum[0] += m;
  }
};

}  // namespace whipple::device
