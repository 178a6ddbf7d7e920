// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/device/nodes.hpp"
#include "src/device/reduction.hpp"
#include "src/device/stencil.hpp"

/// Heat conduction in shocks (docs/theory/dissipation.md, eq. 8 and 9).
namespace whipple::device {

/// Constants of a body.
struct ConductingBody {
  double heat_capacity;  ///< J/(kg K); 0: does not conduct
  double linear_viscosity, quadratic_viscosity;
};

/// Exchange of particles with their nodes.
struct Exchange {
  Points points;
  const ConductingBody* bodies;
  double cell_size, per_rate;  ///< m; dt / (dx times the inertia in dx^2), s/m
  double scale, onset, rise;   ///< of eq. 8

  [[nodiscard]] WHIPPLE_POINT const ConductingBody& body_of(std::size_t p) const {
    return bodies[points.body[p]];
  }
  /// Returns the fraction chi of its difference to the nodes that a particle loses in the step (eq. 8).
  [[nodiscard]] WHIPPLE_POINT double share(std::size_t p) const {
    constexpr double largest_share = 0.9;  // so that temperatures remain in their range
    const double closing = points.at(closing_rate, p) * cell_size, c = points.at(sound_speed, p);
    const double above = closing - onset * c;
    if (!(above > 0.0)) return 0.0;
    const double grown = std::fmin(1.0, above / (rise * c));
    const ConductingBody& body = body_of(p);
    const double speed = body.quadratic_viscosity * closing + body.linear_viscosity * c;
    return std::fmin(largest_share, scale * per_rate * grown * speed);
  }
};

/// Counts the particles that conduct.
struct AnyConducts {
  using Result = Reduction<0, 1>;
  Exchange exchange;
  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    if (exchange.share(p) > 0.0 && exchange.body_of(p).heat_capacity > 0.0) result.raise(0, 1.0);
  }
};

/// Sums C, C T and C chi of the particles of a cell at one of its nodes; C is the heat capacity.
template <class Lattice>
struct SumCapacity {
  Lattice lattice;
  Exchange exchange;
  Node* sums;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    sums[i] = sum_of_cell(lattice, i, [&](std::uint32_t p, const Place& n, Node& sum) {
      const double weight = seen(weights_at(lattice, exchange.points.vector(position, p), 0.0), n).n;
      const double capacity = weight * exchange.points.at(mass, p) * exchange.body_of(p).heat_capacity;
      sum.n[0] += capacity;
      sum.n[1] += capacity * exchange.points.at(temperature, p);
      sum.n[2] += capacity * exchange.share(p);
    });
  }
};

/// Adds the capacities beyond a mirror plane to their images.
template <class Lattice>
struct FoldCapacity {
  Lattice lattice;
  Plane plane;
  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const std::int32_t other = plane.mirror_of(lattice, node, 1);
    if (other == nowhere) return;
    for (std::size_t k = 0; k < 3; ++k) lattice.nodes[node].n[k] += lattice.nodes[other].n[k];
  }
};

/// Sets n[0] = chi T and n[1] = chi of a node.
struct ShareOfNode {
  Node* nodes;
  WHIPPLE_POINT void operator()(std::size_t i) const {
    constexpr double no_capacity = 1e-300;  // J/K; below it the temperature of a node has no meaning
    Node& node = nodes[i];
    const double capacity = node.n[0];
    const bool has = capacity >= no_capacity;
    const double share = has ? node.n[2] / capacity : 0.0;
    node.n[0] = has ? share * node.n[1] / capacity : 0.0;
    node.n[1] = share;
  }
};
/// Lets the nodes beyond a mirror plane have what their images have.
template <class Lattice>
struct CopyShares {
  Lattice lattice;
  Plane plane;
  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const std::int32_t image = plane.mirror_of(lattice, node, -1);
    if (image == nowhere) return;
    for (std::size_t k = 0; k < 2; ++k) lattice.nodes[node].n[k] = lattice.nodes[image].n[k];
  }
};

/// Adds to the energy of the particle at a position of the order what its nodes give (eq. 9); sums what particles gain, J.
template <class Lattice>
struct ExchangeHeat {
  using Result = Reduction<1, 0>;
  Lattice lattice;
  Exchange exchange;
  const std::uint32_t* cell_of_ordered;

  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const std::uint32_t p = lattice.order[i];
    const std::int32_t* const nodes =
        lattice.nodes_of_cell + static_cast<std::size_t>(cell_of_ordered[i]) * Lattice::stencil_nodes;
    double weighted = 0.0, share = 0.0;
    const Points& points = exchange.points;
    for_each_seen(weights_at(lattice, points.vector(position, p), 0.0), [&](int n, const SeenNode& at) {
      const Node& node = lattice.nodes[nodes[n]];
      weighted += at.n * node.n[0];
      share += at.n * node.n[1];
    });
    const double gain = exchange.body_of(p).heat_capacity * (weighted - share * points.at(temperature, p));
    points.at(energy, p) += gain;
    result.sum[0] += points.at(mass, p) * std::fmax(gain, 0.0);
  }
};

}  // namespace whipple::device
