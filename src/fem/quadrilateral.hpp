// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "src/fem/hexahedron.hpp"
#include "src/fem/mesh.hpp"

/// The quadrilateral of a plane or axisymmetric section (docs/theory/fem.md, 8): a hexahedron without depth, whose
/// corners 4 to 7 are the nodes of its corners 0 to 3. A slice of unit depth or a ring; its volume is D A, with the
/// area A of the section and D = 1 m or 2 pi r, r the mean radius of the corners. T is a number or a register.
namespace whipple::fem {

/// Computes the volume of an element of a quadrature and its gradient with respect to the modes.
/// @param radius  m, mean of the corners; used by rings
template <Quadrature quadrature, class T>
[[gnu::always_inline]] inline VolumeGradient<T> volume_gradient_of(const Modes<T>& x, const T& radius) {
  if constexpr (!is_flat(quadrature)) return volume_gradient(x);
  const Triple<T>&a = x.xi, &b = x.eta;
  const T zero{};
  T half_depth = zero + 0.5;
  if constexpr (quadrature == Quadrature::ring) half_depth = std::numbers::pi * radius;
  VolumeGradient<T> g{};
  g.xi = {half_depth * b.y, -(half_depth * b.x), zero};
  g.eta = {-(half_depth * a.y), half_depth * a.x, zero};
  g.volume = (8.0 * half_depth) * (a.x * b.y - a.y * b.x);
  return g;
}

/// Returns the measure of the stiffness of a one-point element, sum_a |B_a|^2 for hexahedra (eq. 5.1). That of a
/// quadrilateral is 3/2 of its own, equal to that of a hexahedron as deep as it is wide, and contains its hoop.
template <Quadrature quadrature, class T>
[[gnu::always_inline]] inline T stiffness_of(const VolumeGradient<T>& g, const T& radius) {
  if constexpr (!is_flat(quadrature)) return g.squared_norm();
  T sum = 1.5 * g.squared_norm();
  if constexpr (quadrature == Quadrature::ring) {
    const T hoop = g.volume / radius;
    sum += (3.0 / 16.0) * (hoop * hoop);
  }
  return sum;
}

/// Returns the length of a one-point element (m): the edge of a cube or of a square far from the axis (eq. 5.2).
template <Quadrature quadrature, class T>
[[gnu::always_inline]] inline T length_of(const VolumeGradient<T>& g, const T& radius) {
  return g.volume / sqrt((2.0 / 3.0) * stiffness_of<quadrature>(g, radius));
}

/// Calls f with the shape of a quadrature as a constant, `f.template operator()<quadrature>()`; B-bar has the
/// hexahedron of one point.
template <class Function>
decltype(auto) with_shape_of(Quadrature quadrature, Function&& f) {
  switch (quadrature) {
    case Quadrature::plane:
      return f.template operator()<Quadrature::plane>();
    case Quadrature::ring:
      return f.template operator()<Quadrature::ring>();
    default:
      return f.template operator()<Quadrature::one_point>();
  }
}

}  // namespace whipple::fem
