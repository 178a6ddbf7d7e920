// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/device/cells.hpp"
#include "src/device/conduction.hpp"
#include "src/device/domains.hpp"
#include "src/device/fill.hpp"
#include "src/device/nodes.hpp"
#include "src/device/problem.hpp"
#include "src/device/scatter.hpp"

/// Passes of the step that take several kernels.
namespace whipple::device {

/// Calls a kernel of nodes for each mirror plane.
/// @param reverse  from the last to the first
template <template <class> class Kernel, class Space, class Lattice>
void at_mirrors(Space& space, const Cells<Space, Lattice>& cells, bool reverse = false) {
  const Lattice& lattice = cells.lattice();
  for (int n = 0; n < 6; ++n) {
    const int face = reverse ? 5 - n : n;
    if (!lattice.mirrors[static_cast<std::size_t>(face)].active) continue;
    space.for_each(cells.nodes(), Kernel<Lattice>{lattice, plane_of(lattice, face)});
  }
}

/// Returns the mass (kg) under strong pressure in cells that material does not fill (fill.hpp).
/// @param reflecting  faces with mirror planes or walls, one bit each
template <class Space, class Lattice>
double mass_beside_voids(Space& space, Cells<Space, Lattice>& cells, const Points& points,
                         const Problem& problem, std::uint32_t reflecting) {
  const Lattice& lattice = cells.lattice();
  space.for_each(cells.stencils(), SumVolumes<Lattice>{lattice, points, cells.sums()});
  space.for_each(cells.nodes(), SumNodes<Lattice>{lattice, cells.sums(), lattice.nodes});
  for (int face = 0; face < 6; ++face) {
    if ((reflecting >> face & 1U) != 0) space.for_each(cells.nodes(), FoldVolumes<Lattice>{lattice, face});
  }
  space.for_each(cells.nodes(), JoinVolumes<Lattice>{lattice, reflecting});
  return space
      .reduce(points.size, MassBesideVoids<Lattice>{.lattice = lattice,
                                                    .points = points,
                                                    .cell_of_ordered = cells.cell_of_ordered(),
                                                    .strong = problem.strong_pressure,
                                                    .filled = problem.filled})
      .sum[0];
}

/// Conducts heat in shocks (conduction.hpp).
/// @returns what has changed places, J
template <class Space, class Lattice>
double exchange_heat(Space& space, Cells<Space, Lattice>& cells, const Exchange& exchange) {
  const Lattice& lattice = cells.lattice();
  const std::size_t size = exchange.points.size;
  if (!(space.reduce(size, AnyConducts{exchange}).largest[0] > 0.0)) return 0.0;
  space.for_each(cells.stencils(), SumCapacity<Lattice>{lattice, exchange, cells.sums()});
  space.for_each(cells.nodes(), SumNodes<Lattice>{lattice, cells.sums(), lattice.nodes});
  at_mirrors<FoldCapacity>(space, cells);
  space.for_each(cells.nodes(), ShareOfNode{lattice.nodes});
  at_mirrors<CopyShares>(space, cells, true);
  return space.reduce(size, ExchangeHeat<Lattice>{lattice, exchange, cells.cell_of_ordered()}).sum[0];
}

/// Returns whether any particle must be divided (domains.hpp).
/// @param bodies  that are followed, on the device
template <class Space>
bool any_too_long(Space& space, const Points& points, const DomainsOfBody* bodies, const Problem& problem) {
  return space
             .reduce(points.size, AnyTooLong{.points = points,
                                             .bodies = bodies,
                                             .limits = problem.domain_limits,
                                             .lower = problem.lower,
                                             .upper = problem.upper()})
             .largest[0] > 0.0;
}

}  // namespace whipple::device
