// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/shape_function.hpp"

/// Sums over the nodes that a particle reaches: the inner loops of the gathers. They are inlined whatever
/// their size, unrolled over rows and planes, and have no sum that lives longer than it must: the sixteen
/// registers are what bounds them.
namespace whipple::transfer {

/// Sum over nodes with N, and with the derivatives of N.
struct ValueAndGradient {
  Lanes value{};
  std::array<Lanes, 3> gradient{};
};

/// sum of weight[i] * value[i] with weights that add up to 1 (of N), and to 0 (of its derivative, of N r).
/// Three nodes take differences from the middle one: additions have units of their own in the processor, so
/// what counts is the multiplications.
template <std::size_t n>
[[gnu::always_inline]] inline Lanes sum_of_one(const std::array<Lanes, n>& weight,
                                               const std::array<Lanes, n>& value) {
  if constexpr (n == 3) {
    return value[1] + weight[0] * (value[0] - value[1]) + weight[2] * (value[2] - value[1]);
  } else {
    Lanes sum = weight[0] * value[0];
    for (std::size_t i = 1; i < n; ++i) sum += weight[i] * value[i];
    return sum;
  }
}
template <std::size_t n>
[[gnu::always_inline]] inline Lanes sum_of_zero(const std::array<Lanes, n>& weight,
                                                const std::array<Lanes, n>& value) {
  if constexpr (n == 3) {
    return weight[0] * (value[0] - value[1]) + weight[2] * (value[2] - value[1]);
  } else {
    return sum_of_one(weight, value);
  }
}

/// Sums of one vector per node, built up direction by direction: along the rows in z, over the rows of a
/// plane, over the planes. `slope` stands for the derivatives of N, or for N r.
template <std::size_t n>
struct RowSums {
  std::array<Lanes, n> value, slope;
  [[gnu::always_inline]] void set(std::size_t row, const std::array<Lanes, n>& weight,
                                  const std::array<Lanes, n>& slopes, const std::array<Lanes, n>& nodes) {
    value[row] = sum_of_one(weight, nodes);
    slope[row] = sum_of_zero(slopes, nodes);
  }
};
template <std::size_t n>
struct PlaneSums {
  std::array<Lanes, n> value, slope_y, slope_z;
  [[gnu::always_inline]] void set(std::size_t plane, const std::array<Lanes, n>& weight,
                                  const std::array<Lanes, n>& slopes, const RowSums<n>& rows) {
    value[plane] = sum_of_one(weight, rows.value);
    slope_y[plane] = sum_of_zero(slopes, rows.value);
    slope_z[plane] = sum_of_one(weight, rows.slope);
  }
  [[gnu::always_inline]] ValueAndGradient total(const std::array<Lanes, n>& weight,
                                                const std::array<Lanes, n>& slopes) const {
    return {sum_of_one(weight, value),
            {sum_of_zero(slopes, value), sum_of_one(weight, slope_y), sum_of_one(weight, slope_z)}};
  }
};

/// Weights of one direction for all nodes of a stencil, each in all lanes.
template <std::size_t n>
struct Direction {
  std::array<Lanes, n> weight, derivative, distance, moment;  ///< N, dN/dx, r, N r
  template <int count>
  [[gnu::always_inline]] Direction(const Weights<count>& w, std::size_t a)
      : weight(of_direction(w.weight, a)),
        derivative(of_direction(w.derivative, a)),
        distance(of_direction(w.distance, a)) {
    for (std::size_t i = 0; i < n; ++i) moment[i] = weight[i] * distance[i];
  }
};

/// Sums over the nodes of a particle (docs/theory/mpm.md, equations 4.2 to 4.7); lane 3 of each is
/// meaningless, but for the increment.
struct Moments {
  ValueAndGradient velocity;   // v + d
  ValueAndGradient increment;  // d
  ValueAndGradient change;     // d - beta D, with N r instead of the derivatives
  Lanes loss;                  // beta D (2 D - beta D) + (d - beta D)^2, per component
};

/// D = a_p(x_i) - v_i is the difference of the particle's affine field and the grid's velocity at node i.
template <bool affine, int count, class Stencil>
[[gnu::always_inline]] inline Moments gather(const Weights<count>& w, Lanes v, const std::array<Lanes, 3>& c,
                                             const Stencil& nodes) {
  constexpr std::size_t n = count;
  const Direction<n> x(w, 0), y(w, 1), z(w, 2);
  std::array<Lanes, n> field_z;
  for (std::size_t k = 0; k < n; ++k) field_z[k] = z.distance[k] * c[2];
  PlaneSums<n> velocity, increment, change;
  std::array<Lanes, n> loss;
  for (std::size_t i = 0; i < n; ++i) {
    Lanes field_x = v;
    if constexpr (affine) field_x += broadcast(w.distance[i][0]) * c[0];
    RowSums<n> row_velocity, row_increment, row_change;
    std::array<Lanes, n> row_loss;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      Lanes field_y = field_x;
      if constexpr (affine) field_y += y.distance[j] * c[1];
      std::array<Lanes, n> new_velocity, d, changed, lost;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n; ++k) {
        const grid::Node& node = nodes(i, j, k);
        Lanes field = field_y;
        if constexpr (affine) field += field_z[k];
        const Lanes beta = broadcast_from(reinterpret_cast<const double*>(&node.first) + 3);
        const Lanes difference = field - node.first, relaxed = beta * difference;
        d[k] = node.second;
        new_velocity[k] = node.first + d[k];
        changed[k] = d[k] - relaxed;
        lost[k] = changed[k] * changed[k] + relaxed * ((difference - relaxed) + difference);
      }
      row_velocity.set(j, z.weight, z.derivative, new_velocity);
      row_increment.set(j, z.weight, z.derivative, d);
      row_change.set(j, z.weight, z.moment, changed);
      row_loss[j] = sum_of_one(z.weight, lost);
    }
    velocity.set(i, y.weight, y.derivative, row_velocity);
    increment.set(i, y.weight, y.derivative, row_increment);
    change.set(i, y.weight, y.moment, row_change);
    loss[i] = sum_of_one(y.weight, row_loss);
  }
  return {velocity.total(x.weight, x.derivative), increment.total(x.weight, x.derivative),
          change.total(x.weight, x.moment), sum_of_one(x.weight, loss)};
}

/// Sums of one vector per node, value(i, j, k).
template <bool with_gradient, int count, class Value>
[[gnu::always_inline]] inline ValueAndGradient gather_value(const Weights<count>& w, Value&& value) {
  constexpr std::size_t n = count;
  const Direction<n> x(w, 0), y(w, 1), z(w, 2);
  PlaneSums<n> planes;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    RowSums<n> rows;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      std::array<Lanes, n> nodes;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n; ++k) nodes[k] = value(i, j, k);
      rows.set(j, z.weight, z.derivative, nodes);
    }
    planes.set(i, y.weight, y.derivative, rows);
  }
  return planes.total(x.weight, x.derivative);
}

}  // namespace whipple::transfer
