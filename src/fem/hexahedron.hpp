// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "src/core/base/registers.hpp"

/// The trilinear hexahedron expanded in modes (docs/theory/fem.md, 2): a nodal field u_a = sum_k u_k phi_k(xi_a) with
/// phi = 1, xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta. T is a number, or a register of numbers for several
/// elements.
namespace whipple::fem {

/// Lists the natural coordinates of the corners (or of the adjacent Gauss points, times sqrt(3)).
constexpr std::array<std::array<double, 3>, 8> corner_coordinates = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
constexpr double gauss_coordinate = 0.57735026918962576451;  ///< 1/sqrt(3)

using std::sqrt;  // of a number, beside those of registers
using whipple::sqrt;

/// Holds the coefficients of a nodal vector field, without the constant mode.
template <class T>
struct Modes {
  Triple<T> xi, eta, zeta, eta_zeta, zeta_xi, xi_eta, xi_eta_zeta;
};

template <class T>
[[gnu::always_inline]] inline Modes<T> operator+(const Modes<T>& a, const Modes<T>& b) {
  return {a.xi + b.xi,
          a.eta + b.eta,
          a.zeta + b.zeta,
          a.eta_zeta + b.eta_zeta,
          a.zeta_xi + b.zeta_xi,
          a.xi_eta + b.xi_eta,
          a.xi_eta_zeta + b.xi_eta_zeta};
}
template <class S, class T>
[[gnu::always_inline]] inline Modes<T> operator*(const S& s, const Modes<T>& a) {
  return {s * a.xi, s * a.eta, s * a.zeta, s * a.eta_zeta, s * a.zeta_xi, s * a.xi_eta, s * a.xi_eta_zeta};
}

/// Transforms corner values to modes: u_k = sum_a phi_ka u_a / 8 (eq. 2.2) for one component of a field, given u_a / 8.
template <class T>
[[gnu::always_inline]] inline std::array<T, 7> modes_of_eighths(const std::array<T, 8>& u) {
  const T s0 = u[1] + u[0], d0 = u[1] - u[0], s1 = u[2] + u[3], d1 = u[2] - u[3];
  const T s2 = u[5] + u[4], d2 = u[5] - u[4], s3 = u[6] + u[7], d3 = u[6] - u[7];
  const T ss0 = s1 + s0, ds0 = s1 - s0, sd0 = d1 + d0, dd0 = d1 - d0;
  const T ss1 = s3 + s2, ds1 = s3 - s2, sd1 = d3 + d2, dd1 = d3 - d2;
  return {sd1 + sd0, ds1 + ds0, ss1 - ss0, ds1 - ds0, sd1 - sd0, dd1 + dd0, dd1 - dd0};
}
/// Assembles the modes of a field from those of its components.
template <class T>
[[gnu::always_inline]] inline Modes<T> modes_by_components(const std::array<T, 7>& x,
                                                           const std::array<T, 7>& y,
                                                           const std::array<T, 7>& z) {
  const auto mode = [&](std::size_t k) __attribute__((always_inline)) { return Triple<T>{x[k], y[k], z[k]}; };
  return {mode(0), mode(1), mode(2), mode(3), mode(4), mode(5), mode(6)};
}
template <class T>
[[gnu::always_inline]] inline Modes<T> modes_of(const std::array<Triple<T>, 8>& u) {
  std::array<T, 8> x, y, z;
  for (std::size_t a = 0; a < 8; ++a) {
    x[a] = 0.125 * u[a].x;
    y[a] = 0.125 * u[a].y;
    z[a] = 0.125 * u[a].z;
  }
  return modes_by_components(modes_of_eighths(x), modes_of_eighths(y), modes_of_eighths(z));
}

/// Transforms modes to corner values: u_a = sum_k phi_ka u_k, without the constant mode.
template <class T>
[[gnu::always_inline]] inline std::array<Triple<T>, 8> corners_of(const Modes<T>& m) {
  const Triple<T> xi_low = m.xi - m.zeta_xi, xi_high = m.xi + m.zeta_xi;
  const Triple<T> eta_low = m.eta - m.eta_zeta, eta_high = m.eta + m.eta_zeta;
  const Triple<T> both_low = m.xi_eta - m.xi_eta_zeta, both_high = m.xi_eta + m.xi_eta_zeta;
  // xi + eta and xi - eta at zeta = -1 and +1
  const Triple<T> sum_low = xi_low + eta_low, difference_low = xi_low - eta_low;
  const Triple<T> sum_high = xi_high + eta_high, difference_high = xi_high - eta_high;
  const Triple<T> even_low = both_low - m.zeta, odd_low = both_low + m.zeta;
  const Triple<T> even_high = both_high + m.zeta, odd_high = both_high - m.zeta;
  return {even_low - sum_low,          difference_low - odd_low,     even_low + sum_low,
          -(odd_low + difference_low), even_high - sum_high,         difference_high - odd_high,
          even_high + sum_high,        -(odd_high + difference_high)};
}

/// Holds the derivatives beta_k of one eighth of the volume with respect to the modes of the position (eq. 2.4); that
/// of the last mode vanishes. They satisfy sum_a u_a B_a^T = 8 sum_k u_k beta_k^T, B_a = dV/dx_a.
template <class T>
struct VolumeGradient {
  Triple<T> xi, eta, zeta, eta_zeta, zeta_xi, xi_eta;
  T volume;

  /// Returns sum_a |B_a|^2.
  [[nodiscard]] T squared_norm() const {
    return 8.0 * (dot(xi, xi) + dot(eta, eta) + dot(zeta, zeta) + dot(eta_zeta, eta_zeta) +
                  dot(zeta_xi, zeta_xi) + dot(xi_eta, xi_eta));
  }
};

/// Computes the volume and its gradient (eq. 2.3, 2.4).
template <class T>
[[gnu::always_inline]] inline VolumeGradient<T> volume_gradient(const Modes<T>& x) {
  const auto third = [](const Triple<T>& a) { return (1.0 / 3.0) * a; };
  const Triple<T>&a = x.xi, &b = x.eta, &c = x.zeta, &d = x.eta_zeta, &e = x.zeta_xi, &f = x.xi_eta;
  VolumeGradient<T> g;
  g.xi = cross(b, c) + third(cross(f, e));
  g.eta = cross(c, a) + third(cross(d, f));
  g.zeta = cross(a, b) + third(cross(e, d));
  g.eta_zeta = third(cross(f, b) + cross(c, e));
  g.zeta_xi = third(cross(d, c) + cross(a, f));
  g.xi_eta = third(cross(e, a) + cross(b, d));
  // V/8 = [a, b, c] + ([a, f, e] + [b, d, f] + [c, e, d])/3
  g.volume = 8.0 * (dot(a, g.xi) + (1.0 / 3.0) * (dot(b, cross(d, f)) + dot(c, cross(e, d))));
  return g;
}

/// Computes the volume only.
template <class T>
[[gnu::always_inline]] inline T volume_of(const Modes<T>& x) {
  const Triple<T>&a = x.xi, &b = x.eta, &c = x.zeta, &d = x.eta_zeta, &e = x.zeta_xi, &f = x.xi_eta;
  return 8.0 * (dot(a, cross(b, c) + (1.0 / 3.0) * cross(f, e)) +
                (1.0 / 3.0) * (dot(b, cross(d, f)) + dot(c, cross(e, d))));
}

/// Returns sum_k u_k beta_k, the mean gradient of one component of a field times an eighth of the volume.
template <class T>
[[gnu::always_inline]] inline Triple<T> mean_gradient_times_eighth(const std::array<T, 7>& u,
                                                                   const VolumeGradient<T>& g) {
  Triple<T> sum = u[0] * g.xi;
  sum += u[1] * g.eta;
  sum += u[2] * g.zeta;
  sum += u[3] * g.eta_zeta;
  sum += u[4] * g.zeta_xi;
  sum += u[5] * g.xi_eta;
  return sum;
}

/// Returns the derivatives of a field with respect to the natural coordinates at a point (columns).
template <class T>
[[gnu::always_inline]] inline Columns<T> natural_gradient(const Modes<T>& u, double xi, double eta,
                                                          double zeta) {
  return {u.xi + zeta * u.zeta_xi + eta * u.xi_eta + (eta * zeta) * u.xi_eta_zeta,
          u.eta + zeta * u.eta_zeta + xi * u.xi_eta + (zeta * xi) * u.xi_eta_zeta,
          u.zeta + eta * u.eta_zeta + xi * u.zeta_xi + (xi * eta) * u.xi_eta_zeta};
}

/// Computes x^(1/3) for x in [1/2, 2] to round-off: by the series about 1 if |x - 1| is below 0.002, otherwise by two
/// Halley iterations starting from the cubic. Outside of that range, returns a positive number.
template <class T>
[[gnu::always_inline]] inline T cube_root_near_one(T x) {
  const T e = x - 1.0, room = 4e-6 - e * e, e2 = e * e;
  const T series = (1.0 + (1.0 / 3.0) * e) +
                   e2 * ((-1.0 / 9.0 + (5.0 / 81.0) * e) + e2 * (-10.0 / 243.0 + (22.0 / 729.0) * e));
  if (all_positive(room)) return series;
  T y = 1.0 + e * (1.0 / 3.0 + e * (-1.0 / 9.0 + (5.0 / 81.0) * e));
  for (int i = 0; i < 2; ++i) {
    const T cube = y * y * y;
    y = y * (cube + 2.0 * x) / (2.0 * cube + x);
  }
  return room > 0.0 ? series : y;
}

/// Holds measures of the size of an element from eight Gauss points.
template <class T>
struct EightPointSize {
  T length;          ///< m (eq. 5.4); for a cube its edge
  T least_jacobian;  ///< m^3
};
template <class T>
[[gnu::always_inline]] inline EightPointSize<T> eight_point_size(const Modes<T>& x,
                                                                 const VolumeGradient<T>& g) {
  T trace{}, least{};  // integral of sum_a |grad N_a|^2; minimum Jacobian
  for (std::size_t q = 0; q < 8; ++q) {
    const double xi = gauss_coordinate * corner_coordinates[q][0],
                 eta = gauss_coordinate * corner_coordinates[q][1],
                 zeta = gauss_coordinate * corner_coordinates[q][2];
    const Columns<T> jacobian = natural_gradient(x, xi, eta, zeta), c = cofactors(jacobian);
    const T det = determinant(jacobian);
    // sum_a dN_a/dxi_i dN_a/dxi_j is 2/9 for i = j, xi_i xi_j / 6 otherwise
    trace += ((2.0 / 9.0) * (dot(c.x, c.x) + dot(c.y, c.y) + dot(c.z, c.z)) +
              (1.0 / 3.0) *
                  ((xi * eta) * dot(c.x, c.y) + (eta * zeta) * dot(c.y, c.z) + (zeta * xi) * dot(c.z, c.x))) /
             det;
    least = q == 0 ? det : minimum(least, det);
  }
  const T stiffness = maximum(g.squared_norm() / g.volume, (9.0 / 16.0) * trace);
  return {sqrt(1.5 * g.volume / stiffness), least};
}

}  // namespace whipple::fem
