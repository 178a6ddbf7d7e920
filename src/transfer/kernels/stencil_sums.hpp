// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "src/core/base/vectors.hpp"
#include "src/transfer/kernels/access.hpp"
#include "src/transfer/point_values.hpp"
#include "src/transfer/shape_weights.hpp"

/// Sums over the nodes of a stencil, built up direction by direction.
namespace whipple::transfer {

/// Points that are gathered at a time; if there are fewer, the last is repeated.
template <class Vector>
using PointsOfGroup = std::array<std::uint32_t, points_of<Vector>>;

/// These points with their places, or weights where the place alone is not enough, and nodes.
template <class Vector, class ShapeOfGroup, class Access>
struct Group {
  using Shape = ShapeOfGroup;
  PointsOfGroup<Vector> point;
  std::array<const grid::PlaceInStencil*, points_of<Vector>> place;
  std::array<const Weights<Shape::count>*, points_of<Vector>> weights;
  std::array<typename Access::Stencil, points_of<Vector>> stencil;

  [[nodiscard]] WHIPPLE_INLINE Vector first(std::size_t i, std::size_t j, std::size_t k) const {
    return by_points<Vector>([&](std::size_t m)
                                 WHIPPLE_INLINE -> Lanes { return first_register(stencil[m](i, j, k)); });
  }
  [[nodiscard]] WHIPPLE_INLINE Vector second(std::size_t i, std::size_t j, std::size_t k) const {
    return by_points<Vector>([&](std::size_t m)
                                 WHIPPLE_INLINE -> Lanes { return stencil[m](i, j, k).registers.second; });
  }
};

/// One direction of the stencils of a group: of values at its nodes the sum with N, and with it the sum with
/// slopes: those of N (`derivatives` of them make 1/m), or N r, whose sums over the nodes vanish.
template <class Vector, class Shape>
class Direction {
 public:
  static constexpr std::size_t n = Shape::count;
  using Values = std::array<Vector, n>;
  Values distance;  ///< r, m

  template <class Group>
  WHIPPLE_INLINE Direction(const Group& group, std::size_t a, const Cells&) {
    const auto& w = group.weights;
    for (std::size_t k = 0; k < n; ++k) {
      weight_[k] = component_by_points<Vector>(
          [&](std::size_t m) WHIPPLE_INLINE -> const Lanes& { return w[m]->weight[k]; }, a);
      derivative_[k] = component_by_points<Vector>(
          [&](std::size_t m) WHIPPLE_INLINE -> const Lanes& { return w[m]->derivative[k]; }, a);
      distance[k] = component_by_points<Vector>(
          [&](std::size_t m) WHIPPLE_INLINE -> const Lanes& { return w[m]->distance[k]; }, a);
      moment_[k] = weight_[k] * distance[k];
    }
  }
  WHIPPLE_INLINE Vector sum(const Values& f) const {
    Vector of_weight, of_slopes;
    sums(weight_, f, of_weight, of_slopes);
    return of_weight;
  }
  WHIPPLE_INLINE void with_derivatives(const Values& f, Vector& of_weight, Vector& of_derivatives) const {
    sums(derivative_, f, of_weight, of_derivatives);
  }
  WHIPPLE_INLINE void with_moments(const Values& f, Vector& of_weight, Vector& of_moments) const {
    sums(moment_, f, of_weight, of_moments);
  }
  WHIPPLE_INLINE Vector derivatives(Vector sum) const { return sum; }

 private:
  /// Three nodes take differences from the middle one, which both sums share.
  WHIPPLE_INLINE void sums(const Values& slopes, const Values& f, Vector& of_weight,
                           Vector& of_slopes) const {
    if constexpr (n == 3) {
      const Vector before = f[0] - f[1], behind = f[2] - f[1];
      of_weight = multiply_add(weight_[2], behind, multiply_add(weight_[0], before, f[1]));
      of_slopes = multiply_add(slopes[2], behind, slopes[0] * before);
    } else {
      of_weight = weight_[0] * f[0];
      of_slopes = slopes[0] * f[0];
      for (std::size_t k = 1; k < n; ++k) {
        of_weight = multiply_add(weight_[k], f[k], of_weight);
        of_slopes = multiply_add(slopes[k], f[k], of_slopes);
      }
    }
  }

  Values weight_, derivative_, moment_;  // N, dN/dx, N r
};

/// Quadratic B-splines: with y in cells from the middle node, N_0 = (y - 1/2)^2/2, N_2 = (y + 1/2)^2/2 and the slopes
/// times dx {a, -2 a - 1, a + 1}, a = w(y) - 1/2.
template <class Vector>
class Direction<Vector, QuadraticBSpline> {
 public:
  static constexpr std::size_t n = 3;
  using Values = std::array<Vector, n>;
  Values distance;

  template <class Group>
  WHIPPLE_INLINE Direction(const Group& group, std::size_t a, const Cells& cells) {
    const auto x = by_points<Vector>([&](std::size_t m)
                                         WHIPPLE_INLINE { return broadcast(group.place[m]->from_first(a)); });
    const Vector y = x - 1.0, to_first = y - 0.5, to_last = y + 0.5;
    a_ = multiply_add(cells.slope_smoothing[a] * y, 0.25 - y * y, to_first);  // (2.9)
    before_ = 0.5 * to_first * to_first;
    behind_ = 0.5 * to_last * to_last;
    distance = {-cells.size * x, cells.size * (1.0 - x), cells.size * (2.0 - x)};
    moment_before_ = before_ * distance[0];
    moment_behind_ = behind_ * distance[2];
    per_cell_ = 1.0 / cells.size;
  }
  WHIPPLE_INLINE Vector sum(const Values& f) const {
    return multiply_add(behind_, f[2] - f[1], multiply_add(before_, f[0] - f[1], f[1]));
  }
  WHIPPLE_INLINE void with_derivatives(const Values& f, Vector& of_weight, Vector& of_derivatives) const {
    const Vector before = f[0] - f[1], behind = f[2] - f[1];
    of_derivatives = multiply_add(a_, before + behind, behind);
    of_weight = multiply_add(behind_, behind, multiply_add(before_, before, f[1]));
  }
  WHIPPLE_INLINE void with_moments(const Values& f, Vector& of_weight, Vector& of_moments) const {
    const Vector before = f[0] - f[1], behind = f[2] - f[1];
    of_weight = multiply_add(behind_, behind, multiply_add(before_, before, f[1]));
    of_moments = multiply_add(moment_behind_, behind, moment_before_ * before);
  }
  WHIPPLE_INLINE Vector derivatives(Vector sum) const { return per_cell_ * sum; }

 private:
  Vector a_;                              // dx times the slope of N_0
  Vector before_, behind_;                // N_0, N_2
  Vector moment_before_, moment_behind_;  // N_0 r_0, N_2 r_2
  double per_cell_;
};

/// The one node along z of a stencil in a plane.
template <class Vector>
struct FlatDirection {
  static constexpr std::size_t n = 1;
  using Values = std::array<Vector, n>;
  Values distance{};

  template <class Group>
  WHIPPLE_INLINE FlatDirection(const Group&, std::size_t, const Cells&) {}
  WHIPPLE_INLINE static Vector sum(const Values& f) { return f[0]; }
  WHIPPLE_INLINE static void with_derivatives(const Values& f, Vector& of_weight, Vector& of_derivatives) {
    of_weight = f[0];
    of_derivatives = Vector{};
  }
  WHIPPLE_INLINE static void with_moments(const Values& f, Vector& of_weight, Vector& of_moments) {
    of_weight = f[0];
    of_moments = Vector{};
  }
};

/// The directions x and y, and z.
template <class Vector, class Shape>
using Along = Direction<Vector, typename AlongAxis<Shape>::type>;
template <class Vector, class Shape>
using AlongZ = std::conditional_t<Planar<Shape>, FlatDirection<Vector>, Along<Vector, Shape>>;

enum class Slopes { derivatives, moments };

/// Sums of one vector per node, built up direction by direction: along the rows in z, over the rows of a
/// plane, over the planes.
template <class Vector, class Direction, Slopes kind>
struct NodeSums {
  static constexpr std::size_t n = Direction::n;
  using Values = std::array<Vector, n>;
  struct Rows {
    Values value, slope;
  };
  Values value, slope_y, slope_z;

  template <class Any>
  WHIPPLE_INLINE static void add_up(const Any& along, const typename Any::Values& f, Vector& value,
                                    Vector& slope) {
    if constexpr (kind == Slopes::derivatives) {
      along.with_derivatives(f, value, slope);
    } else {
      along.with_moments(f, value, slope);
    }
  }
  template <class DirectionOfZ>
  WHIPPLE_INLINE static void set_row(Rows& rows, std::size_t row, const DirectionOfZ& z,
                                     const typename DirectionOfZ::Values& f) {
    add_up(z, f, rows.value[row], rows.slope[row]);
  }
  WHIPPLE_INLINE void set_plane(std::size_t plane, const Direction& y, const Rows& rows) {
    add_up(y, rows.value, value[plane], slope_y[plane]);
    slope_z[plane] = y.sum(rows.slope);
  }
  WHIPPLE_INLINE ValueAndGradient<Vector> total(const Direction& x) const {
    ValueAndGradient<Vector> total;
    add_up(x, value, total.value, total.gradient[0]);
    total.gradient[1] = x.sum(slope_y);
    total.gradient[2] = x.sum(slope_z);
    if constexpr (kind == Slopes::derivatives) {
      for (Vector& slope : total.gradient) slope = x.derivatives(slope);
    }
    return total;
  }
};

/// Value and gradient between the eight nodes of a cell, direction by direction.
/// @tparam Value  Lanes, or both registers of a node
/// @param node    node(i, j, k)
template <class Value, class GetNode>
WHIPPLE_INLINE inline ValueAndGradient<Value> between_nodes(const std::array<Value, 3>& from_first,
                                                            const Value& per_cell, const GetNode& node) {
  struct Edge {
    Value value, along;
  };
  const auto between = [](const Value& f, const Value& before, const Value& behind) WHIPPLE_INLINE {
    const Value along = behind - before;
    return Edge{multiply_add(f, along, before), along};
  };
  struct Face {
    Edge y;
    Value z;
  };
  std::array<Face, 2> faces;
#pragma GCC unroll 2
  for (std::size_t i = 0; i < 2; ++i) {
    const Edge low = between(from_first[2], node(i, 0, 0), node(i, 0, 1)),
               high = between(from_first[2], node(i, 1, 0), node(i, 1, 1));
    faces[i] = {between(from_first[1], low.value, high.value),
                between(from_first[1], low.along, high.along).value};
  }
  const Edge x = between(from_first[0], faces[0].y.value, faces[1].y.value);
  return {x.value,
          {per_cell * x.along, per_cell * between(from_first[0], faces[0].y.along, faces[1].y.along).value,
           per_cell * between(from_first[0], faces[0].z, faces[1].z).value}};
}

}  // namespace whipple::transfer
