// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/device/reduction.hpp"
#include "src/device/stencil.hpp"

/// Sums of particles at nodes without concurrent additions, in two passes: for every node of the stencil of a cell those
/// of the particles of the cell, then at every node those of the cells that reach it, 27 or in two dimensions 9.
namespace whipple::device {

/// Sums mass, momentum, mass times sound speed and force of the particles of a cell at one of its nodes (docs/theory/mpm.md,
/// 3.1 to 3.3).
template <class Lattice>
struct SumCells {
  Lattice lattice;
  Points points;
  Triple<double> acceleration;  ///< by loads, m/s^2
  Node* sums;                   ///< of the stencil_nodes of each cell

  WHIPPLE_POINT void operator()(std::size_t i) const {
    sums[i] = sum_of_cell(lattice, i, [this](std::uint32_t p, const Place& n, Node& sum) { add(p, n, sum); });
  }

 private:
  WHIPPLE_POINT void add(std::size_t p, const Place& n, Node& sum) const {
    const Triple<double> x = points.vector(position, p);
    const SeenNode at = seen(weights_at(lattice, x, lattice.slope_smoothing), n);
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
    if constexpr (Lattice::planar) {  // of a ring, towards the axis
      if (lattice.has_rings) sum.n[6] -= at.n * (volume_ * (s.zz + mean) / x.y);
    }
  }
};

/// Sums the force (N) along the radius by which the hoop stress of rings, which acts on nodes, changes their momentum.
struct SumHoopForce {
  using Result = Reduction<1, 0>;
  Points points;

  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    const double hoop =
        points.at(deviator + 2, p) - (points.at(pressure, p) + points.at(artificial_viscosity, p));
    result.sum[0] += points.at(volume, p) * hoop / points.at(position + 1, p);
  }
};

/// Adds at a node the sums of the cells that reach it.
template <class Lattice>
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
        for (int z = 0; z < Lattice::stencil_edge_z; ++z) {
          constexpr int least = -Lattice::block_edge;
          const Place first = {at.x - x, at.y - y, at.z - z};
          if (first.x < least || first.y < least || first.z < least) continue;
          const std::int32_t begin = lattice.node_at(field, first);
          if (begin == nowhere) continue;
          const std::int32_t cell = lattice.cell_at_node[begin];
          if (cell == nowhere) continue;
          const int n = (x * stencil_edge + y) * Lattice::stencil_edge_z + z;
          const Node& from =
              sums[static_cast<std::size_t>(cell) * Lattice::stencil_nodes + static_cast<std::size_t>(n)];
          for (std::size_t k = 0; k < 8; ++k) sum.n[k] += from.n[k];
        }
      }
    }
    nodes[node] = sum;
  }
};

}  // namespace whipple::device
