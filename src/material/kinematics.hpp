// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/base/tensor.hpp"

/// Kinematics of one step from its velocity gradient (docs/theory/material.md, section 1).
namespace whipple {

/// Symmetric part of a matrix.
inline SymmetricTensor symmetric_part(const Matrix3& m) {
  return {m(0, 0),
          m(1, 1),
          m(2, 2),
          0.5 * (m(0, 1) + m(1, 0)),
          0.5 * (m(1, 2) + m(2, 1)),
          0.5 * (m(2, 0) + m(0, 2))};
}

inline double trace(const SymmetricTensor& a) { return a.xx + a.yy + a.zz; }

/// a:b
inline double contract(const SymmetricTensor& a, const SymmetricTensor& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

inline void scale(SymmetricTensor& a, double factor) {
  a.xx *= factor;
  a.yy *= factor;
  a.zz *= factor;
  a.xy *= factor;
  a.yz *= factor;
  a.zx *= factor;
}

/// Equivalent (von Mises) stress of a deviator, sqrt(3/2 s:s).
inline double equivalent_stress(const SymmetricTensor& deviator) {
  return std::sqrt(1.5 * deviator.squared_norm());
}

/// J = det(I + dt L): ratio of the volumes after and before the step (eq. 1).
inline double volume_ratio(const Matrix3& gradient, double dt) {
  return (Matrix3::Identity() + dt * gradient).determinant();
}

/// Velocity gradient with respect to the midpoint configuration, L (I + dt/2 L)^-1 (eq. 2). Where the half
/// step nearly inverts the point (the volume change is then limited anyway), L itself.
inline Matrix3 midpoint_gradient(const Matrix3& gradient, double dt) {
  const Matrix3 half = Matrix3::Identity() + 0.5 * dt * gradient;
  Matrix3 inverse;
  double determinant = 0.0;
  bool invertible = false;
  half.computeInverseAndDetWithCheck(inverse, determinant, invertible);
  return invertible && determinant > 0.1 ? Matrix3(gradient * inverse) : gradient;
}

/// Rotation of the step, R = (I - W/2)^-1 (I + W/2) with the spin increment W (skew): Hughes and Winget, Int.
/// J. Numer. Meth. Eng. 15 (1980) 1862, eq. 21. For a skew W the inverse is closed: R = I + (W + W^2/2) / (1
/// + |w|^2/4), w the axial vector of W.
inline Matrix3 step_rotation(const Matrix3& midpoint, double dt) {
  const Matrix3 spin = 0.5 * dt * (midpoint - midpoint.transpose());
  const double axial_squared = spin(0, 1) * spin(0, 1) + spin(1, 2) * spin(1, 2) + spin(2, 0) * spin(2, 0);
  return Matrix3::Identity() + (spin + 0.5 * (spin * spin)) / (1.0 + 0.25 * axial_squared);
}

/// R a R^T
inline SymmetricTensor rotated(const SymmetricTensor& a, const Matrix3& rotation) {
  return SymmetricTensor::from(rotation * a.matrix() * rotation.transpose());
}

}  // namespace whipple
