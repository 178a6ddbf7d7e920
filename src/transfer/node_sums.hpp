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

/// sum <- sum + weight * value, or its first term.
[[gnu::always_inline]] inline void add(bool first, Lanes& sum, Lanes weight, Lanes value) {
  sum = first ? weight * value : sum + weight * value;
}

/// Sums over the nodes of a particle (docs/theory/mpm.md, equations 4.2 to 4.7); lane 3 of each is
/// meaningless, but for `weighted_increment`.
struct Moments {
  ValueAndGradient velocity;    // v + d
  Lanes change;                 // d - beta D
  std::array<Lanes, 3> moment;  // (d - beta D) r
  Lanes loss;                   // beta D (2 D - beta D) + (d - beta D)^2, per component
  Lanes weighted_increment;     // d times what `Weighting` says
};

/// What the increments are weighted with, component by component: N value + dN/dx gradient[0] + dN/dy
/// gradient[1]
/// + dN/dz gradient[2]. With the columns of a stress the sum is its work on the strain of the increment.
struct Weighting {
  Lanes value{};
  std::array<Lanes, 3> gradient{};
};

/// D = a_p(x_i) - v_i is the difference of the particle's affine field and the grid's velocity at node i. The
/// sums are built up direction by direction: over the nodes of a row along z, the rows of a plane, the
/// planes.
template <bool affine, int count, class Stencil>
[[gnu::always_inline]] inline Moments gather(const Weights<count>& w, Lanes v, const std::array<Lanes, 3>& c,
                                             const Weighting& weighting, const Stencil& nodes) {
  constexpr std::size_t n = count;
  const std::array<Lanes, n> weight = of_direction(w.weight, 2), slope = of_direction(w.derivative, 2);
  std::array<Lanes, n> weight_r, field_z;
  if constexpr (affine) {
    for (std::size_t k = 0; k < n; ++k) {
      const Lanes distance = broadcast(w.distance[k][2]);
      weight_r[k] = weight[k] * distance;
      field_z[k] = distance * c[2];
    }
  }
  Lanes velocity{}, gradient_x{}, gradient_y{}, gradient_z{};
  Lanes change{}, moment_x{}, moment_y{}, moment_z{}, loss{}, weighted{};
  for (std::size_t i = 0; i < n; ++i) {
    const Lanes wx = broadcast(w.weight[i][0]), gx = broadcast(w.derivative[i][0]);
    const Lanes distance_x = broadcast(w.distance[i][0]);
    const Lanes weighting_x = wx * weighting.value + gx * weighting.gradient[0];
    const Lanes weighting_y = wx * weighting.gradient[1], weighting_z = wx * weighting.gradient[2];
    Lanes field_x = v;
    if constexpr (affine) field_x += distance_x * c[0];
    Lanes plane_velocity, plane_gradient_y, plane_gradient_z;
    Lanes plane_change, plane_moment_y, plane_moment_z, plane_loss;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      const Lanes wy = broadcast(w.weight[j][1]), gy = broadcast(w.derivative[j][1]);
      const Lanes distance_y = broadcast(w.distance[j][1]);
      Lanes field_y = field_x;
      if constexpr (affine) field_y += distance_y * c[1];
      Lanes row_velocity, row_gradient, row_change, row_moment, row_loss, row_increment, row_slope;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n; ++k) {
        const grid::Node& node = nodes(i, j, k);
        const Lanes d = node.second, new_velocity = node.first + d;
        const Lanes beta = broadcast_from(reinterpret_cast<const double*>(&node.first) + 3);
        Lanes difference = field_y - node.first;
        if constexpr (affine) difference += field_z[k];
        const Lanes relaxed = beta * difference, changed = d - relaxed;
        const Lanes lost = changed * changed + relaxed * (2.0 * difference - relaxed);
        add(k == 0, row_velocity, weight[k], new_velocity);
        add(k == 0, row_gradient, slope[k], new_velocity);
        add(k == 0, row_increment, weight[k], d);
        add(k == 0, row_slope, slope[k], d);
        add(k == 0, row_change, weight[k], changed);
        if constexpr (affine) add(k == 0, row_moment, weight_r[k], changed);
        add(k == 0, row_loss, weight[k], lost);
      }
      add(j == 0, plane_velocity, wy, row_velocity);
      add(j == 0, plane_gradient_y, gy, row_velocity);
      add(j == 0, plane_gradient_z, wy, row_gradient);
      add(j == 0, plane_change, wy, row_change);
      if constexpr (affine) {
        add(j == 0, plane_moment_y, wy * distance_y, row_change);
        add(j == 0, plane_moment_z, wy, row_moment);
      }
      add(j == 0, plane_loss, wy, row_loss);
      weighted += (wy * weighting_x + gy * weighting_y) * row_increment + (wy * weighting_z) * row_slope;
    }
    velocity += wx * plane_velocity;
    gradient_x += gx * plane_velocity;
    gradient_y += wx * plane_gradient_y;
    gradient_z += wx * plane_gradient_z;
    change += wx * plane_change;
    if constexpr (affine) {
      moment_x += (wx * distance_x) * plane_change;
      moment_y += wx * plane_moment_y;
      moment_z += wx * plane_moment_z;
    }
    loss += wx * plane_loss;
  }
  return {{velocity, {gradient_x, gradient_y, gradient_z}},
          change,
          {moment_x, moment_y, moment_z},
          loss,
          weighted};
}

/// Sums of one vector per node, value(i, j, k).
template <bool with_gradient, int count, class Value>
[[gnu::always_inline]] inline ValueAndGradient gather_value(const Weights<count>& w, Value&& value) {
  constexpr std::size_t n = count;
  const std::array<Lanes, n> weight = of_direction(w.weight, 2), slope = of_direction(w.derivative, 2);
  ValueAndGradient m;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    Lanes plane, plane_gradient_y, plane_gradient_z;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      Lanes row, row_gradient;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n; ++k) {
        const Lanes node = value(i, j, k);
        add(k == 0, row, weight[k], node);
        if constexpr (with_gradient) add(k == 0, row_gradient, slope[k], node);
      }
      const Lanes wy = broadcast(w.weight[j][1]);
      add(j == 0, plane, wy, row);
      if constexpr (with_gradient) {
        add(j == 0, plane_gradient_y, broadcast(w.derivative[j][1]), row);
        add(j == 0, plane_gradient_z, wy, row_gradient);
      }
    }
    const Lanes wx = broadcast(w.weight[i][0]);
    add(i == 0, m.value, wx, plane);
    if constexpr (with_gradient) {
      add(i == 0, m.gradient[0], broadcast(w.derivative[i][0]), plane);
      add(i == 0, m.gradient[1], wx, plane_gradient_y);
      add(i == 0, m.gradient[2], wx, plane_gradient_z);
    }
  }
  return m;
}

}  // namespace whipple::transfer
