// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "src/core/base/dialect.hpp"

/// Formulas of a table for one point, without its storage; Number is double, or a register of four points.
namespace whipple::eos::table {

/// Evaluates a quintic polynomial, its first and half of its second derivative; coefficient(i) is that of t^i.
template <class Number, class Coefficient>
WHIPPLE_POINT inline void horner(const Coefficient& coefficient, Number t, Number& value, Number& slope,
                                 Number& half_curvature) {
  const Number c5 = coefficient(5), v4 = c5 * t + coefficient(4);
  const Number s3 = c5 * t + v4, v3 = v4 * t + coefficient(3);
  const Number h2 = c5 * t + s3, s2 = s3 * t + v3, v2 = v3 * t + coefficient(2);
  const Number h1 = h2 * t + s2, s1 = s2 * t + v2, v1 = v2 * t + coefficient(1);
  half_curvature = h1 * t + s1;
  slope = s1 * t + v1;
  value = v1 * t + coefficient(0);
}

/// Identifies which of n equal intervals contains a position from 0 to 1, and the local coordinate in it.
struct Piece {
  std::uint32_t index;
  double local;
};
WHIPPLE_POINT inline Piece piece(double position, std::uint32_t n) {
  const double scaled = position * n;  // the order of the arguments below turns NaN into 0
  const auto index =
      static_cast<std::uint32_t>(static_cast<std::int32_t>(std::min(std::max(0.0, scaled), n - 1.0)));
  return {index, scaled - index};
}

/// Holds derivatives of S with respect to two coordinates.
template <class Number>
struct Polynomial {
  Number x, y, xx, xy, yy;
};

/// Returns the derivatives of S with respect to the coordinates of a cell, each from 0 to 1.
WHIPPLE_POINT inline Polynomial<double> polynomial(const double* cell, double tx, double ty) {
  std::array<double, 6> a0{}, a1{}, a2{};
  for (std::size_t i = 0; i < 6; ++i)
    horner([&](std::size_t j) { return cell[6 * j + i]; }, tx, a0[i], a1[i], a2[i]);
  Polynomial<double> s{};
  double value = 0, half = 0;
  horner([&](std::size_t i) { return a0[i]; }, ty, value, s.y, half);
  s.yy = 2 * half;
  horner([&](std::size_t i) { return a1[i]; }, ty, s.x, s.xy, half);
  horner([&](std::size_t i) { return 2 * a2[i]; }, ty, s.xx, value, half);
  return s;
}

/// Holds the position of a point in its region: y = (z - z_k)/(z_(k+1) - z_k), the lower edge z_k and the width,
/// with derivatives with respect to x; also of e_0.
template <class Number>
struct Place {
  Number y, inverse_width, inverse_thermal;  ///< 1/(e - e_0)
  Number base_slope, base_curvature;
  Number low_slope, low_curvature, width_slope, width_curvature;
};

/// Holds derivatives of the entropy with respect to x = ln rho and e.
template <class Number>
struct Slopes {
  Number x, e, xx, xe, ee;
};

/// Applies the chain rule from (x, y) to (x, e), with z = ln(e - e_0) and y w = z - z_k.
template <class Number>
WHIPPLE_POINT inline Slopes<Number> slopes(const Polynomial<Number>& s, const Place<Number>& p) {
  const Number g = p.inverse_thermal, u = p.inverse_width, y = p.y;
  const Number e1 = p.base_slope, e2 = p.base_curvature, w1 = p.width_slope, w2 = p.width_curvature;
  const Number z_e = g, z_x = -e1 * g, z_ee = -g * g, z_xe = e1 * g * g, z_xx = -g * (e2 + e1 * e1 * g);
  const Number y_e = z_e * u, y_x = (z_x - p.low_slope - y * w1) * u;
  const Number y_ee = z_ee * u, y_xe = (z_xe - y_e * w1) * u;
  const Number y_xx = (z_xx - p.low_curvature - 2.0 * y_x * w1 - y * w2) * u;
  return {s.x + s.y * y_x, s.y * y_e, s.xx + y_x * (2.0 * s.xy + s.yy * y_x) + s.y * y_xx,
          y_e * (s.xy + s.yy * y_x) + s.y * y_xe, s.yy * y_e * y_e + s.y * y_ee};
}

/// Holds temperature, pressure and c^2.
template <class Number>
struct Thermal {
  Number temperature, pressure, squared_sound_speed;
};

template <class Number>
WHIPPLE_POINT inline Thermal<Number> thermal(Number rho, const Slopes<Number>& s) {
  const Number T = 1.0 / s.e, v = 1.0 / rho;
  const Number p = -rho * T * s.x;
  const Number p_e = -T * (rho * s.xe + p * s.ee);
  const Number p_rho = p * v - T * (s.xx + p * v * s.xe);
  return {T, p, p_rho + p * p_e * (v * v)};
}

/// Minimum distance of edges in z; closer ones are treated as having this distance.
constexpr double least_width = 1e-9;

}  // namespace whipple::eos::table
