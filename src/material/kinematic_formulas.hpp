// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/dialect.hpp"
#include "src/material/stress_rotation.hpp"

/// Kinematics of one point over a step (docs/theory/material.md, sections 1 and 2). T is the type of a component.
namespace whipple::material::formulas {

/// 3x3 matrix; every function on it is inlined straight-line arithmetic.
template <class T>
struct Matrix {
  T xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

/// I + a M
template <class T>
WHIPPLE_POINT inline Matrix<T> identity_plus(double a, const Matrix<T>& m) {
  return {1.0 + a * m.xx, a * m.xy, a * m.xz, a * m.yx,      1.0 + a * m.yy,
          a * m.yz,       a * m.zx, a * m.zy, 1.0 + a * m.zz};
}

template <class T>
WHIPPLE_POINT inline T determinant(const Matrix<T>& m) {
  return m.xx * (m.yy * m.zz - m.yz * m.zy) - m.xy * (m.yx * m.zz - m.yz * m.zx) +
         m.xz * (m.yx * m.zy - m.yy * m.zx);
}

/// Adjugate: inverse times determinant.
template <class T>
WHIPPLE_POINT inline Matrix<T> adjugate(const Matrix<T>& m) {
  return {m.yy * m.zz - m.yz * m.zy, m.xz * m.zy - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
          m.yz * m.zx - m.yx * m.zz, m.xx * m.zz - m.xz * m.zx, m.xz * m.yx - m.xx * m.yz,
          m.yx * m.zy - m.yy * m.zx, m.xy * m.zx - m.xx * m.zy, m.xx * m.yy - m.xy * m.yx};
}

template <class T>
WHIPPLE_POINT inline Matrix<T> multiply(const Matrix<T>& a, const Matrix<T>& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/// Strain and rotation of the step: sym m is the strain increment (eq. 2, 3).
template <class T>
WHIPPLE_POINT inline Matrix<T> midpoint_displacement_gradient(const Matrix<T>& l, double dt) {
  const Matrix<T> half = identity_plus(0.5 * dt, l);
  // The bound acts only where the half step nearly inverts the point; its volume change is limited anyway.
  const T scale = dt / std::max<T>(determinant(half), 0.1);
  const Matrix<T> product = multiply(l, adjugate(half));
  return {scale * product.xx, scale * product.xy, scale * product.xz, scale * product.yx, scale * product.yy,
          scale * product.yz, scale * product.zx, scale * product.zy, scale * product.zz};
}

/// R = I + (W + W^2/2) / (1 + |w|^2/4), w the axial vector of W: closed form of (I - W/2)^-1 (I + W/2)
/// (eq. 4).
template <class T>
WHIPPLE_POINT inline Matrix<T> rotation(const Matrix<T>& m) {
  const T wx = 0.5 * (m.zy - m.yz), wy = 0.5 * (m.xz - m.zx), wz = 0.5 * (m.yx - m.xy);
  const T square = wx * wx + wy * wy + wz * wz;
  const T a = 1.0 / (1.0 + 0.25 * square), b = 0.5 * a;
  return {1.0 + b * (wx * wx - square), b * wx * wy - a * wz,         b * wx * wz + a * wy,
          b * wx * wy + a * wz,         1.0 + b * (wy * wy - square), b * wy * wz - a * wx,
          b * wx * wz - a * wy,         b * wy * wz + a * wx,         1.0 + b * (wz * wz - square)};
}

/// The six components of a symmetric tensor.
template <class T>
struct Symmetric {
  T xx, yy, zz, xy, yz, zx;
};

/// s:s
template <class T>
WHIPPLE_POINT inline T squared_norm(const Symmetric<T>& s) {
  return s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2.0 * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
}

/// s:L, the power of a deviator per volume
template <class T>
WHIPPLE_POINT inline T power(const Symmetric<T>& s, const Matrix<T>& l) {
  return s.xx * l.xx + s.yy * l.yy + s.zz * l.zz + s.xy * (l.xy + l.yx) + s.yz * (l.yz + l.zy) +
         s.zx * (l.xz + l.zx);
}

/// R s R^T
template <class T>
WHIPPLE_POINT inline Symmetric<T> turned(const Symmetric<T>& s, const Matrix<T>& r) {
  const Matrix<T> t = multiply(r, {s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz});
  return {t.xx * r.xx + t.xy * r.xy + t.xz * r.xz, t.yx * r.yx + t.yy * r.yy + t.yz * r.yz,
          t.zx * r.zx + t.zy * r.zy + t.zz * r.zz, t.xx * r.yx + t.xy * r.yy + t.xz * r.yz,
          t.yx * r.zx + t.yy * r.zy + t.yz * r.zz, t.zx * r.xx + t.zy * r.xy + t.zz * r.xz};
}

/// sym m
template <class T>
WHIPPLE_POINT inline Symmetric<T> symmetric(const Matrix<T>& m) {
  return {m.xx, m.yy, m.zz, 0.5 * (m.xy + m.yx), 0.5 * (m.yz + m.zy), 0.5 * (m.zx + m.xz)};
}

/// Strain increment and rotation of one step.
template <class T>
struct Motion {
  Symmetric<T> strain;
  Matrix<T> rotation;
};

template <StressRotation rule, class T>
WHIPPLE_POINT inline Motion<T> motion_of(const Matrix<T>& l, double dt) {
  const Matrix<T> m = midpoint_displacement_gradient(l, dt);
  const Motion<T> midpoint = {symmetric(m), rotation(m)};
  if constexpr (rule == StressRotation::hughes_winget) return midpoint;
  const Matrix<T> f = identity_plus(dt, l);
  if (determinant(f) < 0.1) return midpoint;  // no polar decomposition worth the name; J is limited anyway
  // Newton's iteration R <- (R + R^-T)/2 for the orthogonal factor (Higham, SIAM J. Sci. Stat. Comput. 7
  // (1986) 1160) converges quadratically from F = V R.
  Matrix<T> r = f;
  for (int i = 0; i < 6; ++i) {
    const Matrix<T> cofactor = adjugate(r);
    const T w = 0.5 / determinant(r);
    r = {0.5 * r.xx + w * cofactor.xx, 0.5 * r.xy + w * cofactor.yx, 0.5 * r.xz + w * cofactor.zx,
         0.5 * r.yx + w * cofactor.xy, 0.5 * r.yy + w * cofactor.yy, 0.5 * r.yz + w * cofactor.zy,
         0.5 * r.zx + w * cofactor.xz, 0.5 * r.zy + w * cofactor.yz, 0.5 * r.zz + w * cofactor.zz};
  }
  const Matrix<T> v = multiply(f, {r.xx, r.yx, r.zx, r.xy, r.yy, r.zy, r.xz, r.yz, r.zz});
  const Matrix<T> sum = identity_plus(1.0, v),
                  less = {v.xx - 1.0, v.xy, v.xz, v.yx, v.yy - 1.0, v.yz, v.zx, v.zy, v.zz - 1.0};
  const Matrix<T> e = multiply(less, adjugate(sum));
  const T scale = 2.0 / determinant(sum);
  return {symmetric(Matrix<T>{scale * e.xx, scale * e.xy, scale * e.xz, scale * e.yx, scale * e.yy,
                              scale * e.yz, scale * e.zx, scale * e.zy, scale * e.zz}),
          r};
}

/// Stress of a point after the elastic trial.
template <class T>
struct Trial {
  Symmetric<T> deviator;  ///< Pa
  T equivalent;           ///< sqrt(3/2 s:s), Pa
};
/// Returns the elastic trial of a point (eq. 5): the deviator rotated with the material, and 2 G dev de.
/// @param deviator  before the step, Pa
/// @param modulus   G, Pa
template <class T>
WHIPPLE_POINT inline Trial<T> elastic_trial(const Symmetric<T>& deviator, const Motion<T>& motion,
                                            T modulus) {
  const Symmetric<T>& e = motion.strain;
  const Symmetric<T> t = turned(deviator, motion.rotation);
  const T twice = 2.0 * modulus, mean = (e.xx + e.yy + e.zz) / 3.0;
  const Symmetric<T> s = {t.xx + twice * (e.xx - mean), t.yy + twice * (e.yy - mean),
                          t.zz + twice * (e.zz - mean), t.xy + twice * e.xy,
                          t.yz + twice * e.yz,          t.zx + twice * e.zx};
  return {s, std::sqrt(1.5 * squared_norm(s))};
}

}  // namespace whipple::material::formulas
