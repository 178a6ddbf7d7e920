// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/error.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/shapes.hpp"

/// Choice of a shape function while the program runs.
namespace whipple::transfer {

/// Calls f(Shape{}) for a kind of shape function.
template <class Function>
decltype(auto) with_shape(ShapeFunction kind, Function&& f) {
  switch (kind) {
    case ShapeFunction::linear:
      return f(Linear{});
    case ShapeFunction::gimp:
      return f(Gimp{});
    case ShapeFunction::convected_gimp:
      return f(ConvectedGimp{});
    case ShapeFunction::quadratic_bspline:
      return f(QuadraticBSpline{});
    case ShapeFunction::cubic_bspline:
      return f(CubicBSpline{});
    case ShapeFunction::planar_linear:
      return f(InPlane<Linear>{});
    case ShapeFunction::planar_gimp:
      return f(InPlane<Gimp>{});
    case ShapeFunction::planar_convected_gimp:
      return f(InPlane<ConvectedGimp>{});
    case ShapeFunction::planar_quadratic_bspline:
      return f(InPlane<QuadraticBSpline>{});
    case ShapeFunction::planar_cubic_bspline:
      return f(InPlane<CubicBSpline>{});
  }
  throw InternalError("unknown shape function");
}

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
