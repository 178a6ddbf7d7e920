// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/grid/block_grid.hpp"
#include "src/transfer/shapes.hpp"

/// What the shape functions are asked for by their kind.
namespace whipple::transfer {

inline grid::Stencil stencil(ShapeFunction kind) {
  return with_shape(kind, []<class Shape>(Shape) { return Shape::stencil; });
}

/// Inertia of the affine field per mass, sum of N r r^T along one direction (m^2): its kinetic energy is
/// m inertia |C|^2 / 2. 0 for functions that carry no affine field.
inline double affine_inertia(ShapeFunction kind, double cell_size) {
  return with_shape(kind, [&]<class Shape>(Shape) {
    if constexpr (CarriesAffineField<Shape>) return Shape::second_moment * cell_size * cell_size;
    return 0.0;
  });
}

/// Returns whether the functions can carry an affine field.
inline bool carries_affine_field(ShapeFunction kind) {
  return with_shape(kind, []<class Shape>(Shape) { return CarriesAffineField<Shape>; });
}

}  // namespace whipple::transfer
