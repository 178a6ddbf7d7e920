// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/dialect.hpp"

/// Vectors and matrices of three directions, of numbers or of registers of numbers for several points.
namespace whipple {

/// Holds the components of a vector.
template <class T>
struct Triple {
  T x, y, z;

  WHIPPLE_POINT Triple& operator+=(const Triple& o) {
    x += o.x, y += o.y, z += o.z;
    return *this;
  }
  WHIPPLE_POINT Triple& operator-=(const Triple& o) {
    x -= o.x, y -= o.y, z -= o.z;
    return *this;
  }
};
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Triple<T> operator-(const Triple<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class S, class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Triple<T> operator*(const S& s, const Triple<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline T dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Holds the columns of a 3 x 3 matrix.
template <class T>
struct Columns {
  Triple<T> x, y, z;
};
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Triple<T> operator*(const Columns<T>& m, const Triple<T>& v) {
  return v.x * m.x + v.y * m.y + v.z * m.z;
}
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline T determinant(const Columns<T>& m) {
  return dot(m.x, cross(m.y, m.z));
}
/// Returns the cofactors: the transposed inverse times the determinant.
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline Columns<T> cofactors(const Columns<T>& m) {
  return {cross(m.y, m.z), cross(m.z, m.x), cross(m.x, m.y)};
}
/// Adds a b^T.
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline void add_dyad(Columns<T>& m, const Triple<T>& a,
                                                          const Triple<T>& b) {
  m.x += b.x * a;
  m.y += b.y * a;
  m.z += b.z * a;
}
/// Returns a : b.
template <class T>
[[gnu::always_inline]] WHIPPLE_POINT inline T contraction(const Columns<T>& a, const Columns<T>& b) {
  return dot(a.x, b.x) + dot(a.y, b.y) + dot(a.z, b.z);
}

}  // namespace whipple
