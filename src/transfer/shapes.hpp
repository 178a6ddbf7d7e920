// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "src/core/base/error.hpp"
#include "src/core/base/simd.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/axis_weights.hpp"
#include "src/transfer/shape_kind.hpp"

/// Shape functions as policies: weights of the nodes of one direction. A three-dimensional weight is the
/// product of three of them. Equations: docs/theory/mpm.md, section 2.
namespace whipple::transfer {

/// Cells of the grid as the shape functions see them.
struct Cells {
  // NOLINTNEXTLINE(google-explicit-constructor): a size alone has the derivatives of N as slopes
  constexpr Cells(double edge, double smoothing = 0.0)
      : size(edge), slope_smoothing{smoothing, smoothing, smoothing, smoothing} {}
  /// Those of a grid. Along the radius of rings the slopes are the derivatives of N: with the hoop terms N/r they keep a
  /// uniform pressure in equilibrium at the axis.
  Cells(const grid::BlockGrid& grid, std::size_t slot, double smoothing)
      : Cells(grid.cell_size(slot), smoothing) {
    if (grid.geometry().is_axisymmetric()) slope_smoothing[1] = 0.0;
  }
  /// Returns the smoothing of a direction, of three directions at once in their lanes.
  template <class Number>
  [[nodiscard, gnu::always_inline]] Number smoothing() const {
    if constexpr (std::is_floating_point_v<Number>) {
      return slope_smoothing[0];
    } else {
      return slope_smoothing;
    }
  }
  /// Returns the cells along one direction.
  [[nodiscard]] Cells along(std::size_t direction) const { return {size, slope_smoothing[direction]}; }

  double size;            ///< m
  Lanes slope_smoothing;  ///< of each direction, as of ShapeFunctions
};

/// In the place of a smoothing, where nothing is weighted with slopes.
inline constexpr double no_slopes = 0.0;

/// Piecewise linear functions of the cells: two nodes per direction, gradients jump at the faces of cells.
struct Linear {
  static constexpr auto kind = ShapeFunction::linear;
  static constexpr int count = 2;
  static constexpr grid::Stencil stencil{.shift = 0.0, .count = count};

  template <class Number>
  static AxisWeights<count, Number> weights(Number f, const Cells& cells) {
    AxisWeights<count, Number> w;
    const Number zero{};
    const double per_cell = 1.0 / cells.size;
    w.weight = {1.0 - f, f};
    w.derivative = {zero - per_cell, zero + per_cell};
    w.distance = {-f * cells.size, (1.0 - f) * cells.size};
    return w;
  }
};

/// Quadratic B-splines: three nodes per direction, continuous gradients (Steffen, Kirby & Berzins, IJNME 76
/// (2008) 922). Sum of N r r^T is dx^2/4 everywhere, which the affine transfer relies on. Slopes may be smoother than
/// the derivatives of N (2.9).
struct QuadraticBSpline {
  static constexpr auto kind = ShapeFunction::quadratic_bspline;
  static constexpr int count = 3;
  static constexpr grid::Stencil stencil{.shift = 0.5, .count = count};
  /// Sum of N r r^T along one direction, in dx^2.
  static constexpr double second_moment = 1.0 / 4.0;

  template <class Number>
  [[gnu::always_inline]] static AxisWeights<count, Number> weights(Number g, const Cells& cells) {
    return formulas::quadratic_weights<Number>(g, cells.size, cells.smoothing<Number>());
  }
};

/// Cubic B-splines: four nodes per direction, continuous second derivatives; sum of N r r^T is dx^2/3
/// everywhere.
struct CubicBSpline {
  static constexpr auto kind = ShapeFunction::cubic_bspline;
  static constexpr int count = 4;
  static constexpr grid::Stencil stencil{.shift = 1.0, .count = count};
  static constexpr double second_moment = 1.0 / 3.0;

  template <class Number>
  static AxisWeights<count, Number> weights(Number from_first, const Cells& cells) {
    AxisWeights<count, Number> w;
    const Number f = from_first - 1.0, b = 1.0 - f;
    const double per_cell = 1.0 / cells.size;
    w.weight = {b * b * b / 6.0, 2.0 / 3.0 - f * f * (1.0 - 0.5 * f), 2.0 / 3.0 - b * b * (1.0 - 0.5 * b),
                f * f * f / 6.0};
    w.derivative = {-0.5 * b * b * per_cell, f * (1.5 * f - 2.0) * per_cell, -b * (1.5 * b - 2.0) * per_cell,
                    0.5 * f * f * per_cell};
    w.distance = {-(1.0 + f) * cells.size, -f * cells.size, b * cells.size, (1.0 + b) * cells.size};
    return w;
  }
};

/// Generalised interpolation (GIMP; Bardenhagen & Kober, CMES 5 (2004) 477): the linear functions averaged
/// over the particle's own domain, a box of half-sizes h along the axes (in cells).
template <int nodes>
AxisWeights<nodes> averaged_linear_weights(double from_first, double h, double cell_size) {
  AxisWeights<nodes> w;
  const auto tent = [](double u) { return std::max(0.0, 1.0 - std::abs(u)); };
  // Integral of the tent over [u - h, u + h], without differences of nearly equal numbers: a weight that is
  // all round-off would give its node a mass that is none.
  const auto integral = [h](double u) {
    const double from = std::abs(u) - h, to = std::abs(u) + h;
    if (from >= 1.0) return 0.0;
    const double left = from < 0.0 ? -from * (1.0 + 0.5 * from) : 0.0;  // of the node
    if (to >= 1.0) return from < 0.0 ? left + 0.5 : 0.5 * (1.0 - from) * (1.0 - from);
    return from < 0.0 ? left + to * (1.0 - 0.5 * to) : 2.0 * h * (1.0 - std::abs(u));
  };
  for (std::size_t i = 0; i < nodes; ++i) {
    const double u = from_first - static_cast<double>(i);
    w.weight[i] = integral(u) / (2.0 * h);
    w.derivative[i] = (tent(u + h) - tent(u - h)) / (2.0 * h * cell_size);
    w.distance[i] = -u * cell_size;
  }
  return w;
}

/// GIMP with the domains of the beginning (uniform GIMP): at most half a cell on either side of the particle,
/// so three nodes per direction.
struct Gimp {
  static constexpr auto kind = ShapeFunction::gimp;
  static constexpr int count = 3;
  static constexpr grid::Stencil stencil{.shift = 0.5, .count = count};
  static constexpr double largest_half_size = 0.5;

  static AxisWeights<count> weights(double from_first, double half_size, const Cells& cells) {
    return averaged_linear_weights<count>(from_first, half_size, cells.size);
  }
};

/// GIMP with domains that deform with the material (convected particle GIMP: Wallstedt & Guilkey, J. Comput.
/// Phys. 227 (2008) 9628): four nodes per direction, domains of up to one cell on either side of the
/// particle.
struct ConvectedGimp {
  static constexpr auto kind = ShapeFunction::convected_gimp;
  static constexpr int count = 4;
  static constexpr grid::Stencil stencil{.shift = 1.0, .count = count};
  static constexpr double largest_half_size = 1.0;

  static AxisWeights<count> weights(double from_first, double half_size, const Cells& cells) {
    return averaged_linear_weights<count>(from_first, std::min(half_size, largest_half_size), cells.size);
  }
};

/// A shape function in two dimensions: along z it is 1 at the one node that is reached, and its slope is 0.
template <class Shape>
struct InPlane : Shape {
  using Spatial = Shape;
  static constexpr ShapeFunction kind = in_plane(Shape::kind);
  static constexpr grid::Stencil stencil{
      .shift = Shape::stencil.shift, .count = Shape::stencil.count, .planar = true};
};
template <class Shape>
concept Planar = Shape::stencil.planar;

/// The function of one direction of the plane or of space.
template <class Shape>
struct AlongAxis {
  using type = Shape;
};
template <Planar Shape>
struct AlongAxis<Shape> {
  using type = typename Shape::Spatial;
};

/// Nodes along z.
template <class Shape>
constexpr std::size_t count_z = Planar<Shape> ? 1 : static_cast<std::size_t>(Shape::count);

/// True if the weights depend on the size of the particle.
template <class Shape>
concept Sized = requires { Shape::largest_half_size; };

/// True if the sum of N r r^T is uniform, as the affine transfer requires.
template <class Shape>
concept CarriesAffineField = requires { Shape::second_moment; };

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

}  // namespace whipple::transfer
