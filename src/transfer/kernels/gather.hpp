// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/transfer/formulas.hpp"
#include "src/transfer/kernels/stencil_sums.hpp"

/// Gathers of points from their nodes.
namespace whipple::transfer {

/// D = a_p(x_i) - v_i is the difference of the particle's affine field and the grid's velocity at node i.
template <bool affine, class Vector, class Group>
WHIPPLE_INLINE inline Moments<Vector> moments(const Group& group, const Cells& cells, Vector v,
                                              const std::array<Vector, 3>& c) {
  using InPlaneOrSpace = Along<Vector, typename Group::Shape>;
  using AcrossPlane = AlongZ<Vector, typename Group::Shape>;
  constexpr std::size_t n = InPlaneOrSpace::n, n_z = AcrossPlane::n;
  const InPlaneOrSpace x(group, 0, cells), y(group, 1, cells);
  const AcrossPlane z(group, 2, cells);
  NodeSums<Vector, InPlaneOrSpace, Slopes::derivatives> velocity, increment;
  NodeSums<Vector, InPlaneOrSpace, Slopes::moments> change;
  std::array<Vector, n> loss;
  for (std::size_t i = 0; i < n; ++i) {
    Vector field_x = v;
    if constexpr (affine) field_x = multiply_add(x.distance[i], c[0], field_x);
    typename NodeSums<Vector, InPlaneOrSpace, Slopes::derivatives>::Rows row_velocity, row_increment;
    typename NodeSums<Vector, InPlaneOrSpace, Slopes::moments>::Rows row_change;
    std::array<Vector, n> row_loss;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      Vector field_y = field_x;
      if constexpr (affine) field_y = multiply_add(y.distance[j], c[1], field_y);
      std::array<Vector, n_z> velocities, d, changed, lost;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n_z; ++k) {
        const Vector first = group.first(i, j, k);
        Vector field = field_y;
        if constexpr (affine) field = multiply_add(z.distance[k], c[2], field);
        const Vector beta = relaxation(first, [&](std::size_t m) WHIPPLE_INLINE -> const grid::Node& {
          return group.stencil[m](i, j, k);
        });
        d[k] = group.second(i, j, k);
        velocities[k] = first;
        const formulas::NodeChange<Vector> by_node =
            formulas::change_by_node<Vector>(field - first, d[k], beta);
        changed[k] = by_node.velocity;
        lost[k] = by_node.loss;
      }
      velocity.set_row(row_velocity, j, z, velocities);
      increment.set_row(row_increment, j, z, d);
      change.set_row(row_change, j, z, changed);
      row_loss[j] = z.sum(lost);
    }
    velocity.set_plane(i, y, row_velocity);
    increment.set_plane(i, y, row_increment);
    change.set_plane(i, y, row_change);
    loss[i] = y.sum(row_loss);
  }
  Moments<Vector> total = {velocity.total(x), increment.total(x), change.total(x), x.sum(loss)};
  total.velocity.value += total.increment.value;
  for (std::size_t a = 0; a < 3; ++a) total.velocity.gradient[a] += total.increment.gradient[a];
  return total;
}

/// Sums of one vector per node, value(i, j, k).
template <class Vector, class Group, class Value>
WHIPPLE_INLINE inline ValueAndGradient<Vector> sums_of(const Group& group, const Cells& cells,
                                                       Value&& value) {
  using InPlaneOrSpace = Along<Vector, typename Group::Shape>;
  using AcrossPlane = AlongZ<Vector, typename Group::Shape>;
  constexpr std::size_t n = InPlaneOrSpace::n, n_z = AcrossPlane::n;
  const InPlaneOrSpace x(group, 0, cells), y(group, 1, cells);
  const AcrossPlane z(group, 2, cells);
  NodeSums<Vector, InPlaneOrSpace, Slopes::derivatives> planes;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    typename NodeSums<Vector, InPlaneOrSpace, Slopes::derivatives>::Rows rows;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      std::array<Vector, n_z> nodes;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n_z; ++k) nodes[k] = value(i, j, k);
      planes.set_row(rows, j, z, nodes);
    }
    planes.set_plane(i, y, rows);
  }
  return planes.total(x);
}

/// Gathers from the nodes: `of` sums over the nodes of a group, of which it reads `Content`; `advance`, if
/// present, computes the new values of the points from the sums.
///
/// Velocity and affine field (4.3), transfer dissipation (4.5).
/// @tparam affine  whether the points carry an affine field; its update is not another kernel but a
///                 branch that always goes the same way
template <class Vector, bool affine>
struct TransferSums {
  using Content = grid::Node;
  using Sum = Moments<Vector>;
  using Result = Advance<Vector>;
  AffineField field;
  double dt;

  template <class Points>
  WHIPPLE_INLINE static Vector velocity(const Points& points, const PointsOfGroup<Vector>& p) {
    return by_points<Vector>([&](std::size_t m)
                                 WHIPPLE_INLINE { return load_vector(points.velocity[p[m]].data()); });
  }
  template <class Points>
  WHIPPLE_INLINE static std::array<Vector, 3> affine_field(const Points& points,
                                                           const PointsOfGroup<Vector>& p) {
    std::array<Vector, 3> c{};
    if constexpr (affine) {
      // Lane 3 is that of the next column, or 0.
      c[0] = by_points<Vector>([&](std::size_t m)
                                   WHIPPLE_INLINE { return load(points.affine_velocity[p[m]].data()); });
      c[1] = by_points<Vector>([&](std::size_t m)
                                   WHIPPLE_INLINE { return load(points.affine_velocity[p[m]].data() + 3); });
      c[2] = by_points<Vector>(
          [&](std::size_t m) WHIPPLE_INLINE { return load_vector(points.affine_velocity[p[m]].data() + 6); });
    }
    return c;
  }

  template <class Points, class Group>
  WHIPPLE_INLINE Moments<Vector> of(const Points& points, const Group& group, const Cells& cells) const {
    return moments<affine, Vector>(group, cells, velocity(points, group.point),
                                   affine_field(points, group.point));
  }
  template <class Shape, class Points>
  WHIPPLE_INLINE Advance<Vector> advance(const Points& points, const PointsOfGroup<Vector>& p,
                                         const Moments<Vector>& sums, double cell_size) const {
    const Vector change = sums.change.value;
    std::array<Vector, 3> c = affine_field(points, p);
    Vector heat = formulas::heat_of_velocity(sums.loss, change);
    if constexpr (affine) {
      const double inertia = Shape::second_moment * cell_size * cell_size;  // sum N r r^T in one direction
      auto per_inertia =
          by_points<Vector>([&](std::size_t) WHIPPLE_INLINE { return broadcast(1.0 / inertia); });
      if constexpr (requires { points.unrelaxed; }) {  // some carry no affine field: theirs stays 0
        per_inertia *= by_points<Vector>(
            [&](std::size_t m) WHIPPLE_INLINE { return broadcast(p[m] < points.unrelaxed ? 0.0 : 1.0); });
      }
      for (std::size_t a = 0; a < 3; ++a) {
        const formulas::FieldChange<Vector> gained =
            formulas::change_of_field<Vector>(sums.change.gradient[a], per_inertia);
        heat -= gained.energy;
        c[a] += gained.field;
      }
      heat = sum_of_three(heat);
      if (field == AffineField::deformed) {
        heat += 0.5 * inertia * formulas::convect(c, sums.velocity.gradient, dt);
      }
    } else {
      heat = sum_of_three(heat);
    }
    return {sums.velocity, sums.increment, velocity(points, p) + change, c, heat};
  }
};

/// New velocity of the grid, and its increment in the step.
template <class Vector>
struct UpdateSums {
  using Content = grid::Node;
  template <class Stencil>
  WHIPPLE_INLINE static VelocityUpdate<> between(const grid::PlaceInStencil& place, double per_cell,
                                                 const Stencil& nodes) {
    const auto node = [&](auto... at) WHIPPLE_INLINE { return load_node<Vector>(nodes(at...)); };
    using Both = BothRegisters<Vector>;
    const ValueAndGradient<Both> sums = between_nodes<Both>(
        {broadcast_both<Vector>(place.from_first(0)), broadcast_both<Vector>(place.from_first(1)),
         broadcast_both<Vector>(place.from_first(2))},
        broadcast_both<Vector>(per_cell), node);
    VelocityUpdate<> update;
    update.increment = second_of(sums.value);
    update.after.value = first_of(sums.value) + update.increment;
    for (std::size_t a = 0; a < 3; ++a) {
      update.after.gradient[a] = first_of(sums.gradient[a]) + second_of(sums.gradient[a]);
    }
    return update;
  }
  template <class Points, class Group>
  WHIPPLE_INLINE VelocityUpdate<Vector> of(const Points&, const Group& group, const Cells& cells) const {
    const auto after = [&](auto... node)
                           WHIPPLE_INLINE { return group.first(node...) + group.second(node...); };
    return {sums_of<Vector>(group, cells, after),
            sums_of<Vector>(group, cells, [&](auto... node) WHIPPLE_INLINE {
              return group.second(node...);
            }).value};
  }
};
/// Sums of the first registers.
template <class Vector>
struct FirstSums {
  using Content = Lanes;
  template <class Stencil>
  WHIPPLE_INLINE static ValueAndGradient<> between(const grid::PlaceInStencil& place, double per_cell,
                                                   const Stencil& nodes) {
    const auto node = [&](auto... at) WHIPPLE_INLINE { return Lanes(first_register(nodes(at...))); };
    return between_nodes<Lanes>(
        {broadcast(place.from_first(0)), broadcast(place.from_first(1)), broadcast(place.from_first(2))},
        broadcast(per_cell), node);
  }
  template <class Points, class Group>
  WHIPPLE_INLINE ValueAndGradient<Vector> of(const Points&, const Group& group, const Cells& cells) const {
    return sums_of<Vector>(group, cells, [&](auto... node) WHIPPLE_INLINE { return group.first(node...); });
  }
};

using whipple::of_point;
template <VectorRegister Vector>
WHIPPLE_INLINE inline ValueAndGradient<> of_point(const ValueAndGradient<Vector>& sums, std::size_t i) {
  return {of_point(sums.value, i),
          {of_point(sums.gradient[0], i), of_point(sums.gradient[1], i), of_point(sums.gradient[2], i)}};
}
template <VectorRegister Vector>
WHIPPLE_INLINE inline Advance<> of_point(const Advance<Vector>& sums, std::size_t i) {
  return {of_point(sums.grid_velocity, i),
          of_point(sums.increment, i),
          of_point(sums.velocity, i),
          {of_point(sums.affine[0], i), of_point(sums.affine[1], i), of_point(sums.affine[2], i)},
          of_point(sums.heat, i)};
}
template <VectorRegister Vector>
WHIPPLE_INLINE inline Moments<Lanes> of_point(const Moments<Vector>& sums, std::size_t i) {
  return {of_point(sums.velocity, i), of_point(sums.increment, i), of_point(sums.change, i),
          of_point(sums.loss, i)};
}
template <VectorRegister Vector>
WHIPPLE_INLINE inline VelocityUpdate<> of_point(const VelocityUpdate<Vector>& sums, std::size_t i) {
  return {of_point(sums.after, i), of_point(sums.increment, i)};
}

}  // namespace whipple::transfer
