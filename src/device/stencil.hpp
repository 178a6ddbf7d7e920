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
/// @param smoothing  of the slopes
WHIPPLE_POINT inline StencilWeights weights_at(const Lattice& lattice, const Triple<double>& position,
                                               double smoothing) {
  const Triple<double> at = lattice.in_cells(position);
  const Place first = Lattice::first_node(at);
  using transfer::formulas::quadratic_weights;
  return {quadratic_weights<double>(at.x - first.x, lattice.cell_size, smoothing),
          quadratic_weights<double>(at.y - first.y, lattice.cell_size, smoothing),
          quadratic_weights<double>(at.z - first.z, lattice.cell_size, smoothing)};
}

/// Returns node (i, j, k) of a stencil.
WHIPPLE_POINT inline SeenNode seen(const StencilWeights& w, int i, int j, int k) {
  const double x = pick(w.x.weight, i), y = pick(w.y.weight, j), z = pick(w.z.weight, k);
  return {x * y * z,
          {pick(w.x.derivative, i) * y * z, x * pick(w.y.derivative, j) * z, x * y * pick(w.z.derivative, k)},
          {pick(w.x.distance, i), pick(w.y.distance, j), pick(w.z.distance, k)}};
}

/// Calls f(number in the stencil, node as the particle sees it) for all nodes, z fastest.
template <class Function>
WHIPPLE_POINT inline void for_each_seen(const StencilWeights& w, Function&& f) {
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
      for (int k = 0; k < stencil_edge; ++k) f((i * stencil_edge + j) * stencil_edge + k, seen(w, i, j, k));
    }
  }
}

}  // namespace whipple::device
