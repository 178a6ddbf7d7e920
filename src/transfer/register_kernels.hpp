// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "src/core/base/prefetch.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/shape_weights.hpp"

/// The loops over points and their nodes, kernels/, compiled for two sets of registers: `narrow` for AVX2,
/// whose register holds half a node, and `wide` for AVX-512, whose register holds a node when points bring
/// something to it, and halves of two nodes when two points take something at a time. Lane by lane both
/// compute the same in the same order, so their results are the same bits.
namespace whipple::transfer {

/// Contribution of one point to a node: first += N (a0 + a_x r_x + a_y r_y + a_z r_z), second += N b0 + sum
/// over directions of dN/dx_a b_a.
struct Payload {
  Lanes a0, ax, ay, az;
  Lanes b0, bx, by, bz;
};

/// Sum over nodes with N, and with the derivatives of N.
template <class Vector = Lanes>
struct ValueAndGradient {
  Vector value;
  std::array<Vector, 3> gradient;
};

/// Sums over the nodes of a particle (docs/theory/mpm.md, equations 4.2 to 4.7); lane 3 of each is
/// meaningless, but for the increment.
template <class Vector>
struct Moments {
  ValueAndGradient<Vector> velocity;   ///< v + d
  ValueAndGradient<Vector> increment;  ///< d
  ValueAndGradient<Vector> change;     ///< d - beta D, with N r instead of the derivatives
  Vector loss;                         ///< (d - beta D)^2 + beta D (2 D - beta D), per component
};

/// Result of the step for one point.
template <class Vector = Lanes>
struct Advance {
  ValueAndGradient<Vector> grid_velocity;  ///< after the forces
  ValueAndGradient<Vector> increment;      ///< of it
  Vector velocity;                         ///< of the point
  std::array<Vector, 3> affine;            ///< columns of its affine field
  Vector heat;                             ///< J/kg, in all lanes
};

/// New velocity of the nodes and how much of it came in the step.
template <class Vector = Lanes>
struct VelocityUpdate {
  ValueAndGradient<Vector> after;
  Vector increment;
};

namespace narrow {

/// One point at a time.
using Vector = Lanes;
constexpr std::size_t together = 1;
using whipple::multiply_add;

/// get(0)
template <class Get>
WHIPPLE_INLINE inline Vector of_group(Get&& get) {
  return get(0);
}
WHIPPLE_INLINE inline Lanes part(Vector v, std::size_t) { return v; }
/// Lane a of get(0) in all lanes.
template <class Get>
WHIPPLE_INLINE inline Vector spread(Get&& get, std::size_t a) {
  return broadcast(get(0)[a]);
}
WHIPPLE_INLINE inline Vector lane(Vector v, std::size_t a) { return broadcast(v[a]); }
/// Lanes 1, 2, 0, 3.
WHIPPLE_INLINE inline Vector turned(Vector v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
WHIPPLE_INLINE inline Vector root(Vector v) { return sqrt(v); }
/// Lane 3 of the first register of the points' nodes, in all lanes.
template <class Nodes>
WHIPPLE_INLINE inline Vector relaxation(Vector, const Nodes& node) {
  return broadcast_from(reinterpret_cast<const double*>(&node(0).registers.first) + 3);
}

/// Both registers of a node.
struct Both {
  Lanes first, second;
};
WHIPPLE_INLINE inline Both both(Lanes first, Lanes second) { return {first, second}; }
/// One number in all lanes of the first register, another in those of the second.
WHIPPLE_INLINE inline Both spread_both(double first, double second) {
  return {broadcast(first), broadcast(second)};
}
WHIPPLE_INLINE inline Both spread_both(double same) { return spread_both(same, same); }
WHIPPLE_INLINE inline Both operator*(Both a, Both b) { return {a.first * b.first, a.second * b.second}; }
WHIPPLE_INLINE inline Both operator+(Both a, Both b) { return {a.first + b.first, a.second + b.second}; }
WHIPPLE_INLINE inline Both operator-(Both a, Both b) { return {a.first - b.first, a.second - b.second}; }
WHIPPLE_INLINE inline Both multiply_add(Both a, Both b, Both c) {
  return {multiply_add(a.first, b.first, c.first), multiply_add(a.second, b.second, c.second)};
}
WHIPPLE_INLINE inline Lanes first_of(Both both) { return both.first; }
WHIPPLE_INLINE inline Lanes second_of(Both both) { return both.second; }
WHIPPLE_INLINE inline Both load_node(const grid::Node& node) {
  return {node.registers.first, node.registers.second};
}
WHIPPLE_INLINE inline void store_node(grid::Node& node, Both value) {
  node.registers = {value.first, value.second};
}

#include "src/transfer/kernels/all.inl"

}  // namespace narrow

#if WHIPPLE_WIDE_KERNELS
#if WHIPPLE_OTHER_TARGET
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
#endif
namespace wide {

/// Two points at a time, one in each half.
using Vector [[gnu::vector_size(64)]] = double;
constexpr std::size_t together = 2;
using whipple::multiply_add;

WHIPPLE_INLINE inline Vector join(Lanes low, Lanes high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
/// get(0) and get(1)
template <class Get>
WHIPPLE_INLINE inline Vector of_group(Get&& get) {
  return join(get(0), get(1));
}
WHIPPLE_INLINE inline Lanes part(Vector v, std::size_t i) {
  return i == 0 ? __builtin_shufflevector(v, v, 0, 1, 2, 3) : __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
/// Lane a of each half in all lanes of it.
WHIPPLE_INLINE inline Vector lane(Vector v, std::size_t a) {
  switch (a) {
    case 0:
      return __builtin_shufflevector(v, v, 0, 0, 0, 0, 4, 4, 4, 4);
    case 1:
      return __builtin_shufflevector(v, v, 1, 1, 1, 1, 5, 5, 5, 5);
    case 2:
      return __builtin_shufflevector(v, v, 2, 2, 2, 2, 6, 6, 6, 6);
    default:
      return __builtin_shufflevector(v, v, 3, 3, 3, 3, 7, 7, 7, 7);
  }
}
/// Lane a of get(0) and get(1).
template <class Get>
WHIPPLE_INLINE inline Vector spread(Get&& get, std::size_t a) {
  return lane(of_group(get), a);
}
/// Lanes 1, 2, 0, 3 of each half.
WHIPPLE_INLINE inline Vector turned(Vector v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3, 5, 6, 4, 7);
}
WHIPPLE_INLINE inline Vector root(Vector v) { return Vector(_mm512_maskz_sqrt_pd(0xff, __m512d(v))); }
WHIPPLE_INLINE inline Vector multiply_add(Vector a, Vector b, Vector c) {
  return Vector(_mm512_fmadd_pd(__m512d(a), __m512d(b), __m512d(c)));
}
/// Lane 3 of the first register of the points' nodes, in all lanes.
template <class Nodes>
WHIPPLE_INLINE inline Vector relaxation(Vector first, const Nodes&) {
  return lane(first, 3);
}

/// Both registers of a node.
using Both = Vector;
using NodeRegister [[gnu::vector_size(64), gnu::may_alias]] = double;
WHIPPLE_INLINE inline Both both(Lanes first, Lanes second) { return join(first, second); }
WHIPPLE_INLINE inline Lanes first_of(Both both) { return part(both, 0); }
WHIPPLE_INLINE inline Lanes second_of(Both both) { return part(both, 1); }
/// One number in all lanes of the first half, another in those of the second.
WHIPPLE_INLINE inline Both spread_both(double first, double second) {
  return Vector(_mm512_mask_broadcastsd_pd(_mm512_set1_pd(first), 0xf0, _mm_set_sd(second)));
}
WHIPPLE_INLINE inline Both spread_both(double same) { return Vector(_mm512_set1_pd(same)); }
WHIPPLE_INLINE inline Both load_node(const grid::Node& node) {
  return *reinterpret_cast<const NodeRegister*>(&node);
}
WHIPPLE_INLINE inline void store_node(grid::Node& node, Both value) {
  *reinterpret_cast<NodeRegister*>(&node) = value;
}

#include "src/transfer/kernels/all.inl"

}  // namespace wide
#if WHIPPLE_OTHER_TARGET
#pragma GCC pop_options
#endif
#endif

}  // namespace whipple::transfer
