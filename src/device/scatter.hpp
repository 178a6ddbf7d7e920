// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/device/stencil.hpp"

/// Sums of particles at nodes without concurrent additions, in two passes: for every node of the stencil of a cell those
/// of the particles of the cell, then at every node those of the 27 cells that reach it.
namespace whipple::device {

/// Sums mass, momentum, mass times sound speed and force of the particles of a cell at one of its nodes (docs/theory/mpm.md,
/// 3.1 to 3.3).
struct SumCells {
  Lattice lattice;
  Points points;
  Triple<double> acceleration;  ///< by loads, m/s^2
  Node* sums;                   ///< of the stencil_nodes of each cell

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const std::size_t cell = i / stencil_nodes;
    const int n = static_cast<int>(i % stencil_nodes), ix = n / 9, iy = n / 3 % 3, iz = n % 3;
    Node sum{};
    for (std::uint32_t k = lattice.cell_begin[cell]; k < lattice.cell_begin[cell + 1]; ++k) {
      add(lattice.order[k], ix, iy, iz, sum);
    }
    sums[i] = sum;
  }

 private:
  WHIPPLE_POINT void add(std::size_t p, int ix, int iy, int iz, Node& sum) const {
    const SeenNode at =
        seen(weights_at(lattice, points.vector(position, p), lattice.slope_smoothing), ix, iy, iz);
    const double m = points.at(mass, p), weight = at.n * m;
    const std::array<Triple<double>, 3> c = points.columns(affine, p);
    const Triple<double> v = points.vector(velocity, p) + at.r.x * c[0] + at.r.y * c[1] + at.r.z * c[2];
    const material::formulas::Symmetric<double> s = points.symmetric(deviator, p);
    const double mean = -(points.at(pressure, p) + points.at(artificial_viscosity, p)),
                 volume_ = points.at(volume, p);
    const Triple<double>& g = at.gradient;
    sum.n[0] += weight;
    sum.n[1] += weight * v.x;
    sum.n[2] += weight * v.y;
    sum.n[3] += weight * v.z;
    sum.n[4] += weight * points.at(sound_speed, p);
    sum.n[5] += weight * acceleration.x - volume_ * ((s.xx + mean) * g.x + s.xy * g.y + s.zx * g.z);
    sum.n[6] += weight * acceleration.y - volume_ * (s.xy * g.x + (s.yy + mean) * g.y + s.yz * g.z);
    sum.n[7] += weight * acceleration.z - volume_ * (s.zx * g.x + s.yz * g.y + (s.zz + mean) * g.z);
  }
};

/// Adds at a node the sums of the cells that reach it.
struct SumNodes {
  Lattice lattice;
  const Node* sums;
  Node* nodes;
  std::uint32_t numbers = 8;  ///< that are in use

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const Place at = lattice.place_of(node);
    const std::uint32_t field = lattice.field_of(node);
    Node sum{};
    for (int x = 0; x < stencil_edge; ++x) {
      for (int y = 0; y < stencil_edge; ++y) {
        for (int z = 0; z < stencil_edge; ++z) {
          const Place first = {at.x - x, at.y - y, at.z - z};
          if (first.x < -block_edge || first.y < -block_edge || first.z < -block_edge) continue;
          const std::int32_t begin = lattice.node_at(field, first);
          if (begin == nowhere) continue;
          const std::int32_t cell = lattice.cell_at_node[begin];
          if (cell == nowhere) continue;
          const int n = (x * stencil_edge + y) * stencil_edge + z;
          const Node& from =
              sums[static_cast<std::size_t>(cell) * stencil_nodes + static_cast<std::size_t>(n)];
          for (std::size_t k = 0; k < 8; ++k) sum.n[k] += from.n[k];
        }
      }
    }
    nodes[node] = sum;
  }
};

}  // namespace whipple::device
