// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <type_traits>

#include "src/core/base/vectors.hpp"
#include "src/grid/node.hpp"

/// Both registers of a node, of which one WideLanes holds all and Lanes a half.
namespace whipple::transfer {

/// Points that are gathered at a time: one per vector that a register holds.
template <class Vector>
constexpr std::size_t points_of = width<Vector> / 4;

/// Both registers of a node as two of four doubles.
struct TwoRegisters {
  Lanes first, second;
};
WHIPPLE_INLINE inline TwoRegisters operator*(const TwoRegisters& a, const TwoRegisters& b) {
  return {a.first * b.first, a.second * b.second};
}
WHIPPLE_INLINE inline TwoRegisters operator+(const TwoRegisters& a, const TwoRegisters& b) {
  return {a.first + b.first, a.second + b.second};
}
WHIPPLE_INLINE inline TwoRegisters operator-(const TwoRegisters& a, const TwoRegisters& b) {
  return {a.first - b.first, a.second - b.second};
}
using whipple::multiply_add;
WHIPPLE_INLINE inline TwoRegisters multiply_add(const TwoRegisters& a, const TwoRegisters& b,
                                                const TwoRegisters& c) {
  return {multiply_add(a.first, b.first, c.first), multiply_add(a.second, b.second, c.second)};
}
WHIPPLE_INLINE inline Lanes first_of(const TwoRegisters& both) { return both.first; }
WHIPPLE_INLINE inline Lanes second_of(const TwoRegisters& both) { return both.second; }
WHIPPLE_INLINE inline void store_node(grid::Node& node, const TwoRegisters& value) {
  node.registers = {value.first, value.second};
}

using NodeInRegister [[gnu::vector_size(64), gnu::may_alias]] = double;
#if WHIPPLE_AVX2
WHIPPLE_WIDE inline WideLanes broadcast_halves(double first, double second) {
  return WideLanes(_mm512_mask_broadcastsd_pd(_mm512_set1_pd(first), 0xf0, _mm_set_sd(second)));
}
#else
WideLanes broadcast_halves(double first, double second);  // named, never called
#endif
WHIPPLE_WIDE inline Lanes first_of(WideLanes both) { return half(both, 0); }
WHIPPLE_WIDE inline Lanes second_of(WideLanes both) { return half(both, 1); }
WHIPPLE_WIDE inline void store_node(grid::Node& node, WideLanes value) {
  *reinterpret_cast<NodeInRegister*>(&node) = value;
}

template <class Vector>
using BothRegisters = std::conditional_t<width<Vector> == 4, TwoRegisters, Vector>;

template <class Vector>
WHIPPLE_INLINE inline BothRegisters<Vector> join_registers(Lanes first, Lanes second) {
  if constexpr (width<Vector> == 4) return TwoRegisters{first, second};
  if constexpr (width<Vector> == 8) return join(first, second);
}
/// Returns one number in all lanes of the first register, another in those of the second.
template <class Vector>
WHIPPLE_INLINE inline BothRegisters<Vector> broadcast_both(double first, double second) {
  if constexpr (width<Vector> == 4) return TwoRegisters{broadcast(first), broadcast(second)};
  if constexpr (width<Vector> == 8) return broadcast_halves(first, second);
}
template <class Vector>
WHIPPLE_INLINE inline BothRegisters<Vector> broadcast_both(double same) {
  if constexpr (width<Vector> == 4) return TwoRegisters{broadcast(same), broadcast(same)};
  if constexpr (width<Vector> == 8) return broadcast<Vector>(same);
}
template <class Vector>
WHIPPLE_INLINE inline BothRegisters<Vector> load_node(const grid::Node& node) {
  if constexpr (width<Vector> == 4) return TwoRegisters{node.registers.first, node.registers.second};
  if constexpr (width<Vector> == 8) return *reinterpret_cast<const NodeInRegister*>(&node);
}

/// Returns lane a of get(0), and of get(1) in the second half, in all lanes.
template <class Vector, class Get>
WHIPPLE_INLINE inline Vector component_by_points(Get&& get, std::size_t a) {
  if constexpr (width<Vector> == 4) return broadcast(get(0)[a]);  // from memory
  if constexpr (width<Vector> == 8) return lane(by_points<Vector>(get), a);
}
/// Returns lane 3 of the first register of the points' nodes, in all lanes.
/// @param node  node(number of the point)
template <class Vector, class GetNode>
WHIPPLE_INLINE inline Vector relaxation(Vector first, const GetNode& node) {
  if constexpr (width<Vector> == 4)
    return broadcast_from(reinterpret_cast<const double*>(&node(0).registers.first) + 3);
  if constexpr (width<Vector> == 8) return lane(first, 3);
}

}  // namespace whipple::transfer
