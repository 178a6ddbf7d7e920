// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "src/core/base/vectors.hpp"

/// Formulas of the symplectic scheme at one point and one of its nodes (docs/theory/mpm.md, 4). The kernels for registers
/// and the plain loops sum over nodes in their own ways and use these formulas.
/// @tparam Number  of one component: a number, or a register of numbers
/// @tparam Vector  Triple<double>, or a register whose lanes 0 to 2 are a vector
namespace whipple::transfer::formulas {

/// One component of the change that a node makes at a point.
template <class Number>
struct NodeChange {
  Number velocity;  ///< d - beta D, m/s
  Number loss;      ///< d^2 + 2 beta D (D - d): twice its energy in (4.5), J/kg
};
/// Returns the change of velocity that a node makes (4.1) and its loss (4.5).
/// @param difference  D = v_p + C_p r - v_i, m/s
/// @param increment   d = dt f_i / m_i, m/s
/// @param relaxation  beta
template <class Number>
[[gnu::always_inline]] WHIPPLE_POINT inline NodeChange<Number> change_by_node(const Number& difference,
                                                                              const Number& increment,
                                                                              const Number& relaxation) {
  const Number relaxed = relaxation * difference, rest = difference - increment;
  return {increment - relaxed, multiply_add(relaxed, rest + rest, increment * increment)};
}

/// Returns one component of the heat of a point without affine field (4.5), J/kg.
/// @param loss    sum of N times the losses of the nodes, m^2/s^2
/// @param change  sum of N times their changes of velocity, m/s
template <class Number>
[[gnu::always_inline]] WHIPPLE_POINT inline Number heat_of_velocity(const Number& loss,
                                                                    const Number& change) {
  return 0.5 * (loss - change * change);
}

/// One component of the change of an affine field.
template <class Number>
struct FieldChange {
  Number field;   ///< 1/s
  Number energy;  ///< J/kg, subtracted from the heat (4.5)
};
/// Returns the change of a component of the affine field (4.1, 4.3).
/// @param moment       sum of N (d - beta D) r, m^2/s
/// @param per_inertia  1/I, 1/m^2; 0: the point carries no affine field
template <class Number>
[[gnu::always_inline]] WHIPPLE_POINT inline FieldChange<Number> change_of_field(const Number& moment,
                                                                                const Number& per_inertia) {
  const Number change = per_inertia * moment;
  return {change, 0.5 * change * moment};
}

/// Convects an affine field with the deformation of a step, C <- k C (I + dt L)^-1 (4.8): the velocity of the point
/// belongs to the new position, so its affine field must be carried there. k keeps it from growing. A deformation with
/// det(I + dt L) <= 0.1 has no meaningful inverse and leaves it unchanged.
/// @param c         columns of C, 1/s
/// @param gradient  columns of L, 1/s
/// @returns the loss of |C|^2, 1/s^2
template <class Vector>
[[gnu::always_inline]] WHIPPLE_POINT inline auto convect(std::array<Vector, 3>& c,
                                                         const std::array<Vector, 3>& gradient, double dt) {
  const Vector f0 = unit_vector<Vector>(0) + dt * gradient[0];
  const Vector f1 = unit_vector<Vector>(1) + dt * gradient[1];
  const Vector f2 = unit_vector<Vector>(2) + dt * gradient[2];
  const std::array<Vector, 3> rows = {cross(f1, f2), cross(f2, f0), cross(f0, f1)};  // of the adjugate
  const auto determinant = dot(f0, rows[0]);
  using Scalar = std::remove_cv_t<decltype(determinant)>;
  const auto too_large = determinant <= 0.1;
  const Scalar before = squared_norm(c), inverse = 1.0 / determinant;
  std::array<Vector, 3> carried;  // times the determinant
  for (std::size_t a = 0; a < 3; ++a) {
    carried[a] = component(rows[0], a) * c[0] + component(rows[1], a) * c[1] + component(rows[2], a) * c[2];
  }
  const Scalar after = squared_norm(carried);
  using std::sqrt;
#ifndef __CUDACC__
  using whipple::sqrt;  // of registers
#endif
  const Scalar cap = sqrt(before / after);  // 0/0 is not less than the inverse
  const Scalar scale = cap < inverse ? cap : inverse;
  for (std::size_t a = 0; a < 3; ++a) c[a] = too_large ? c[a] : scale * carried[a];
  return too_large ? Scalar{} : Scalar(before - scale * scale * after);
}

/// Rule by which an affine field fits the cells at a new place (docs/theory/levels.md, 8).
struct FittedField {
  double factor = 1.0;  ///< of the field
  double loss = 0.0;    ///< of kinetic energy per |C|^2 and mass, m^2
};
/// Returns how an affine field fits another inertia: with more it is weaker by as much, and keeps its energy; with less
/// it stays, and loses the rest.
/// @param before, after  inertia per mass where the point was and where it is, m^2
inline FittedField fit_field(double before, double after) {
  if (after > before) return {.factor = std::sqrt(before / after)};
  return {.loss = 0.5 * (before - after)};
}

}  // namespace whipple::transfer::formulas
