// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "src/grid/block_grid.hpp"

/// Shape functions as policies: weights of the nodes of one direction. A three-dimensional weight is the
/// product of three of them. Equations: docs/theory/mpm.md, section 2.
namespace whipple::transfer {

/// Weights, derivatives and distances of the nodes that a particle reaches along one direction.
template <int Count>
struct AxisWeights {
  int first = 0;                         ///< first node, counted from the block's lower corner (>= -1)
  std::array<double, Count> weight;      ///< N
  std::array<double, Count> derivative;  ///< dN/dx, 1/m
  std::array<double, Count> distance;    ///< node position minus particle position, m
};

/// Piecewise linear functions of the cells: two nodes per direction, gradients jump at the faces of cells.
struct Linear {
  static constexpr std::string_view name = "linear";
  static constexpr int count = 2;
  static constexpr grid::Stencil stencil{.shift = 0.0, .count = count};

  /// @param local position in cells from the block's lower corner
  static AxisWeights<count> weights(double local, double cell_size) {
    AxisWeights<count> w;
    const double base = std::floor(local);
    const double f = local - base;
    w.first = static_cast<int>(base);
    w.weight = {1.0 - f, f};
    w.derivative = {-1.0 / cell_size, 1.0 / cell_size};
    w.distance = {-f * cell_size, (1.0 - f) * cell_size};
    return w;
  }
};

/// Quadratic B-splines: three nodes per direction, continuous gradients (Steffen, Kirby & Berzins, IJNME 76
/// (2008) 922). Sum of N r r^T is dx^2/4 everywhere, which the affine transfer relies on.
struct QuadraticBSpline {
  static constexpr std::string_view name = "quadratic_bspline";
  static constexpr int count = 3;
  static constexpr grid::Stencil stencil{.shift = 0.5, .count = count};

  static AxisWeights<count> weights(double local, double cell_size) {
    AxisWeights<count> w;
    const double base = std::floor(local - 0.5);
    const double g = local - base;  // 0.5 .. 1.5
    w.first = static_cast<int>(base);
    w.weight = {0.5 * (1.5 - g) * (1.5 - g), 0.75 - (g - 1.0) * (g - 1.0), 0.5 * (g - 0.5) * (g - 0.5)};
    w.derivative = {(g - 1.5) / cell_size, -2.0 * (g - 1.0) / cell_size, (g - 0.5) / cell_size};
    w.distance = {-g * cell_size, (1.0 - g) * cell_size, (2.0 - g) * cell_size};
    return w;
  }
};

/// Weights of all three directions for a particle at `local` (cells from the block's lower corner).
template <class Shape>
std::array<AxisWeights<Shape::count>, 3> weights_at(const Vector3& local, double cell_size) {
  return {Shape::weights(local[0], cell_size), Shape::weights(local[1], cell_size),
          Shape::weights(local[2], cell_size)};
}

/// Position in cells from the lower corner of a block.
inline Vector3 local_position(const Vector3& position, const grid::Geometry& geometry,
                              const grid::BlockCoordinate& block) {
  Vector3 local = geometry.in_cells(position);
  for (std::size_t a = 0; a < 3; ++a) local[static_cast<Eigen::Index>(a)] -= block[a] * grid::block_edge;
  return local;
}

}  // namespace whipple::transfer
