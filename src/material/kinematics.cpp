// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "src/core/base/simd.hpp"

namespace whipple::material {
namespace {

/// Holds a 3x3 matrix in registers; all functions on it are inlined straight-line arithmetic.
struct Matrix {
  double xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

template <class NineLanes>
inline Matrix load_matrix(const NineLanes& lanes, std::size_t k) {
  return {lanes[0][k], lanes[1][k], lanes[2][k], lanes[3][k], lanes[4][k],
          lanes[5][k], lanes[6][k], lanes[7][k], lanes[8][k]};
}

/// Returns I + a M.
inline Matrix identity_plus(double a, const Matrix& m) {
  return {1.0 + a * m.xx, a * m.xy, a * m.xz, a * m.yx,      1.0 + a * m.yy,
          a * m.yz,       a * m.zx, a * m.zy, 1.0 + a * m.zz};
}

inline double determinant(const Matrix& m) {
  return m.xx * (m.yy * m.zz - m.yz * m.zy) - m.xy * (m.yx * m.zz - m.yz * m.zx) +
         m.xz * (m.yx * m.zy - m.yy * m.zx);
}

/// Returns the adjugate: inverse times determinant.
inline Matrix adjugate(const Matrix& m) {
  return {m.yy * m.zz - m.yz * m.zy, m.xz * m.zy - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
          m.yz * m.zx - m.yx * m.zz, m.xx * m.zz - m.xz * m.zx, m.xz * m.yx - m.xx * m.yz,
          m.yx * m.zy - m.yy * m.zx, m.xy * m.zx - m.xx * m.zy, m.xx * m.yy - m.xy * m.yx};
}

inline Matrix multiply(const Matrix& a, const Matrix& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/// Returns the displacement gradient m of the step, relative to its middle: sym m is the strain increment (eq. 2, 3).
inline Matrix midpoint_displacement_gradient(const Matrix& l, double dt) {
  const Matrix half = identity_plus(0.5 * dt, l);
  // The bound acts only where the half step nearly inverts the point; its volume change is limited in any case.
  const double scale = dt / std::max(determinant(half), 0.1);
  const Matrix product = multiply(l, adjugate(half));
  return {scale * product.xx, scale * product.xy, scale * product.xz, scale * product.yx, scale * product.yy,
          scale * product.yz, scale * product.zx, scale * product.zy, scale * product.zz};
}

/// Returns R = I + (W + W^2/2) / (1 + |w|^2/4), w the axial vector of W: closed form of (I - W/2)^-1 (I + W/2) (eq. 4).
inline Matrix rotation(const Matrix& m) {
  const double wx = 0.5 * (m.zy - m.yz), wy = 0.5 * (m.xz - m.zx), wz = 0.5 * (m.yx - m.xy);
  const double square = wx * wx + wy * wy + wz * wz;
  const double a = 1.0 / (1.0 + 0.25 * square), b = 0.5 * a;
  return {1.0 + b * (wx * wx - square), b * wx * wy - a * wz,         b * wx * wz + a * wy,
          b * wx * wy + a * wz,         1.0 + b * (wy * wy - square), b * wy * wz - a * wx,
          b * wx * wz - a * wy,         b * wy * wz + a * wx,         1.0 + b * (wz * wz - square)};
}

/// Holds the six components of a symmetric tensor.
struct Symmetric {
  double xx, yy, zz, xy, yz, zx;
};

template <class SixLanes>
inline Symmetric load(const SixLanes& lanes, std::size_t k) {
  return {lanes[0][k], lanes[1][k], lanes[2][k], lanes[3][k], lanes[4][k], lanes[5][k]};
}

template <class SixLanes>
inline void store(const Symmetric& s, SixLanes&& lanes, std::size_t k) {
  lanes[0][k] = s.xx;
  lanes[1][k] = s.yy;
  lanes[2][k] = s.zz;
  lanes[3][k] = s.xy;
  lanes[4][k] = s.yz;
  lanes[5][k] = s.zx;
}

/// Returns R s R^T.
inline Symmetric turned(const Symmetric& s, const Matrix& r) {
  const Matrix t = multiply(r, {s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz});
  return {t.xx * r.xx + t.xy * r.xy + t.xz * r.xz, t.yx * r.yx + t.yy * r.yy + t.yz * r.yz,
          t.zx * r.zx + t.zy * r.zy + t.zz * r.zz, t.xx * r.yx + t.xy * r.yy + t.xz * r.yz,
          t.yx * r.zx + t.yy * r.zy + t.yz * r.zz, t.zx * r.xx + t.zy * r.xy + t.zz * r.xz};
}

/// Returns sym m.
inline Symmetric symmetric(const Matrix& m) {
  return {m.xx, m.yy, m.zz, 0.5 * (m.xy + m.yx), 0.5 * (m.yz + m.zy), 0.5 * (m.zx + m.xz)};
}

/// Holds strain increment and rotation of one step.
struct Motion {
  Symmetric strain;
  Matrix rotation;
};

template <StressRotation rule>
inline Motion motion_of(const Matrix& l, double dt) {
  const Matrix m = midpoint_displacement_gradient(l, dt);
  const Motion midpoint = {symmetric(m), rotation(m)};
  if constexpr (rule == StressRotation::hughes_winget) return midpoint;
  const Matrix f = identity_plus(dt, l);
  // Too distorted for a polar decomposition; J is limited in any case
  if (determinant(f) < 0.1) return midpoint;
  // Newton's iteration R <- (R + R^-T)/2 for the orthogonal factor (Higham, SIAM J. Sci. Stat. Comput. 7
  // (1986) 1160) converges quadratically from F = V R.
  Matrix r = f;
  for (int i = 0; i < 6; ++i) {
    const Matrix cofactor = adjugate(r);
    const double w = 0.5 / determinant(r);
    r = {0.5 * r.xx + w * cofactor.xx, 0.5 * r.xy + w * cofactor.yx, 0.5 * r.xz + w * cofactor.zx,
         0.5 * r.yx + w * cofactor.xy, 0.5 * r.yy + w * cofactor.yy, 0.5 * r.yz + w * cofactor.zy,
         0.5 * r.zx + w * cofactor.xz, 0.5 * r.zy + w * cofactor.yz, 0.5 * r.zz + w * cofactor.zz};
  }
  const Matrix v = multiply(f, {r.xx, r.yx, r.zx, r.xy, r.yy, r.zy, r.xz, r.yz, r.zz});
  const Matrix sum = identity_plus(1.0, v),
               less = {v.xx - 1.0, v.xy, v.xz, v.yx, v.yy - 1.0, v.yz, v.zx, v.zy, v.zz - 1.0};
  const Matrix e = multiply(less, adjugate(sum));
  const double scale = 2.0 / determinant(sum);
  return {symmetric({scale * e.xx, scale * e.xy, scale * e.xz, scale * e.yx, scale * e.yy, scale * e.yz,
                     scale * e.zx, scale * e.zy, scale * e.zz}),
          r};
}

}  // namespace

void volume_change(std::size_t size, double dt, Kinematics& step) {
  for (std::size_t k = 0; k < size; ++k) {
    const Matrix l = load_matrix(step.gradient, k);
    step.ratio[k] = determinant(identity_plus(dt, l));
    step.divergence[k] = l.xx + l.yy + l.zz;
  }
}

namespace {

template <StressRotation rule>
void elastic_trial_by(std::size_t size, double dt, Kinematics& step) {
  for (std::size_t k = 0; k < size; ++k) {
    const Motion motion = motion_of<rule>(load_matrix(step.gradient, k), dt);
    const Symmetric& e = motion.strain;
    const Symmetric t = turned(load(step.deviator, k), motion.rotation);
    const double twice = 2.0 * step.modulus[k], mean = (e.xx + e.yy + e.zz) / 3.0;
    const Symmetric s = {t.xx + twice * (e.xx - mean), t.yy + twice * (e.yy - mean),
                         t.zz + twice * (e.zz - mean), t.xy + twice * e.xy,
                         t.yz + twice * e.yz,          t.zx + twice * e.zx};
    store(s, step.deviator, k);
    store(e, step.strain, k);
    const double norm =
        s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2.0 * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
    step.trial[k] = std::sqrt(1.5 * norm);
  }
}

template <StressRotation rule>
void turn_by(std::size_t size, double dt, const MatrixLanes& gradient, std::span<Lanes, 6> tensor) {
  for (std::size_t k = 0; k < size; ++k) {
    store(turned(load(tensor, k), motion_of<rule>(load_matrix(gradient, k), dt).rotation), tensor, k);
  }
}

template <StressRotation rule>
void strain_increment_by(std::size_t size, double dt, const MatrixLanes& gradient, SymmetricLanes& strain) {
  for (std::size_t k = 0; k < size; ++k) {
    store(motion_of<rule>(load_matrix(gradient, k), dt).strain, strain, k);
  }
}

using enum StressRotation;

}  // namespace

WHIPPLE_KERNEL void elastic_trial(std::size_t size, double dt, StressRotation rule, Kinematics& step) {
  rule == polar ? elastic_trial_by<polar>(size, dt, step) : elastic_trial_by<hughes_winget>(size, dt, step);
}

WHIPPLE_KERNEL void turn(std::size_t size, double dt, StressRotation rule, const MatrixLanes& gradient,
                         std::span<Lanes, 6> tensor) {
  rule == polar ? turn_by<polar>(size, dt, gradient, tensor)
                : turn_by<hughes_winget>(size, dt, gradient, tensor);
}

WHIPPLE_KERNEL void deform(std::size_t size, double dt, const MatrixLanes& gradient,
                           std::span<Lanes, 9> deformation) {
  for (std::size_t k = 0; k < size; ++k) {
    const Matrix f = multiply(identity_plus(dt, load_matrix(gradient, k)), load_matrix(deformation, k));
    const double parts[9] = {f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz};
    for (std::size_t e = 0; e < 9; ++e) deformation[e][k] = parts[e];
  }
}

WHIPPLE_KERNEL void strain_increment(std::size_t size, double dt, StressRotation rule,
                                     const MatrixLanes& gradient, SymmetricLanes& strain) {
  rule == polar ? strain_increment_by<polar>(size, dt, gradient, strain)
                : strain_increment_by<hughes_winget>(size, dt, gradient, strain);
}

}  // namespace whipple::material
