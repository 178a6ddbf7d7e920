// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/device/lattice.hpp"
#include "src/device/points.hpp"
#include "src/transfer/axis_weights.hpp"

/// Nodes of a particle with their weights.
namespace whipple::device {

/// Holds the weights of the three directions.
/// @tparam edge_z  nodes along z
template <int edge_z>
struct StencilWeights {
  transfer::AxisWeights<stencil_edge> x, y, z;
};

/// Returns an entry of three without an index at run time, which would put the array into memory.
template <class T>
WHIPPLE_POINT inline T pick(const std::array<T, 3>& of, int i) {
  return i == 0 ? of[0] : i == 1 ? of[1] : of[2];
}

/// Node of a stencil as a particle sees it: N, S (1/m), and r from the particle to the node (m).
struct SeenNode {
  double n;
  Triple<double> gradient, r;
};

/// Returns the weights of a particle.
/// @param smoothing  of the slopes; along the radius of rings these are the derivatives of N (transfer::Cells)
template <class Lattice>
WHIPPLE_POINT inline StencilWeights<Lattice::stencil_edge_z> weights_at(const Lattice& lattice,
                                                                        const Triple<double>& position,
                                                                        double smoothing) {
  const Triple<double> at = lattice.in_cells(position);
  const Place first = Lattice::first_node(at);
  using transfer::formulas::quadratic_weights;
  if constexpr (Lattice::planar) {
    return {quadratic_weights<double>(at.x - first.x, lattice.cell_size, smoothing),
            quadratic_weights<double>(at.y - first.y, lattice.cell_size, lattice.has_rings ? 0.0 : smoothing),
            {{1.0, 0.0, 0.0}, {}, {}}};
  } else {
    return {quadratic_weights<double>(at.x - first.x, lattice.cell_size, smoothing),
            quadratic_weights<double>(at.y - first.y, lattice.cell_size, smoothing),
            quadratic_weights<double>(at.z - first.z, lattice.cell_size, smoothing)};
  }
}

/// Returns node (i, j, k) of a stencil.
template <int edge_z>
WHIPPLE_POINT inline SeenNode seen(const StencilWeights<edge_z>& w, int i, int j, int k) {
  const double x = pick(w.x.weight, i), y = pick(w.y.weight, j), z = pick(w.z.weight, k);
  return {x * y * z,
          {pick(w.x.derivative, i) * y * z, x * pick(w.y.derivative, j) * z, x * y * pick(w.z.derivative, k)},
          {pick(w.x.distance, i), pick(w.y.distance, j), pick(w.z.distance, k)}};
}
template <int edge_z>
WHIPPLE_POINT inline SeenNode seen(const StencilWeights<edge_z>& w, const Place& at) {
  return seen(w, at.x, at.y, at.z);
}

/// Calls f(number in the stencil, node as the particle sees it) for all nodes, z fastest.
template <int edge_z, class Function>
WHIPPLE_POINT inline void for_each_seen(const StencilWeights<edge_z>& w, Function&& f) {
#ifdef __CUDA_ARCH__
#pragma unroll 1
#endif
  for (int i = 0; i < stencil_edge; ++i) {
#ifdef __CUDA_ARCH__
#pragma unroll 1
#endif
    for (int j = 0; j < stencil_edge; ++j) {
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int k = 0; k < edge_z; ++k) f((i * stencil_edge + j) * edge_z + k, seen(w, i, j, k));
    }
  }
}

/// Sums the particles of a cell at one of its nodes, in the order of the list.
/// @param i    number of the node: stencil_nodes for each cell
/// @param add  adds particle p at the place n of its stencil: add(p, n, sum)
template <class Lattice, class Add>
WHIPPLE_POINT inline Node sum_of_cell(const Lattice& lattice, std::size_t i, Add&& add) {
  const std::size_t cell = i / Lattice::stencil_nodes;
  const Place n = Lattice::in_stencil(static_cast<int>(i % Lattice::stencil_nodes));
  Node sum{};
  for (std::uint32_t k = lattice.cell_begin[cell]; k < lattice.cell_begin[cell + 1]; ++k) {
    add(lattice.order[k], n, sum);
  }
  return sum;
}

}  // namespace whipple::device
