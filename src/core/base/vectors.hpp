// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "src/core/base/registers.hpp"

/// Products of vectors under one name for Triple and for registers whose lanes 0 to 2 are a vector (WideLanes: one in
/// each half). Scalars in registers are the same number in all lanes of a vector.
namespace whipple {

template <class T>
concept VectorRegister = !std::is_class_v<T> && (width<T> == 4 || width<T> == 8);

#ifndef __CUDACC__
/// Calls get(0), and get(1) for the second half.
template <VectorRegister Vector, class Get>
WHIPPLE_INLINE inline Vector by_points(Get&& get) {
  if constexpr (width<Vector> == 4) return get(0);
  if constexpr (width<Vector> == 8) return join(get(0), get(1));
}
/// Returns that of point i.
template <VectorRegister Vector>
WHIPPLE_INLINE inline Lanes of_point(Vector v, std::size_t i) {
  if constexpr (width<Vector> == 4) return v;
  if constexpr (width<Vector> == 8) return half(v, i);
}
#endif

template <class Vector>
WHIPPLE_INLINE WHIPPLE_POINT inline Vector unit_vector(std::size_t a) {
  const auto is = [a](std::size_t b) WHIPPLE_INLINE { return a == b ? 1.0 : 0.0; };
#ifndef __CUDACC__
  if constexpr (VectorRegister<Vector>) {
    return by_points<Vector>([&](std::size_t) WHIPPLE_INLINE { return Lanes{is(0), is(1), is(2), 0.0}; });
  }
#endif
  if constexpr (!VectorRegister<Vector>) return {is(0), is(1), is(2)};
}

template <class T>
WHIPPLE_INLINE WHIPPLE_POINT inline T component(const Triple<T>& v, std::size_t a) {
  return a == 0 ? v.x : a == 1 ? v.y : v.z;
}
#ifndef __CUDACC__
template <VectorRegister Vector>
WHIPPLE_INLINE inline Vector component(Vector v, std::size_t a) {
  return lane(v, a);
}
/// Returns the sum of lanes 0 to 2, in all lanes.
template <VectorRegister Vector>
WHIPPLE_INLINE inline Vector sum_of_three(Vector v) {
  return lane(v, 0) + lane(v, 1) + lane(v, 2);
}
template <VectorRegister Vector>
WHIPPLE_INLINE inline Vector dot(Vector a, Vector b) {
  return sum_of_three(a * b);
}
/// Returns a x b, 0 in lane 3.
template <VectorRegister Vector>
WHIPPLE_INLINE inline Vector cross(Vector a, Vector b) {
  return cycled(a * cycled(b) - cycled(a) * b);
}
/// Returns the squared norm of a matrix from its columns.
template <VectorRegister Vector>
WHIPPLE_INLINE inline Vector squared_norm(const std::array<Vector, 3>& columns) {
  return sum_of_three(columns[0] * columns[0] + columns[1] * columns[1] + columns[2] * columns[2]);
}
#endif
template <class T>
WHIPPLE_INLINE WHIPPLE_POINT inline T squared_norm(const std::array<Triple<T>, 3>& columns) {
  return dot(columns[0], columns[0]) + dot(columns[1], columns[1]) + dot(columns[2], columns[2]);
}

}  // namespace whipple
