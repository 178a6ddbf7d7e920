// SPDX-License-Identifier: BSD-3-Clause
// What points take from their nodes (part of src/transfer/register_kernels.hpp)

/// D = a_p(x_i) - v_i is the difference of the particle's affine field and the grid's velocity at node i.
template <bool affine, class Group>
WHIPPLE_INLINE inline Moments<Vector> moments(const Group& group, const Cells& cells, Vector v,
                                              const std::array<Vector, 3>& c) {
  using InPlaneOrSpace = Along<typename Group::Shape>;
  using AcrossPlane = AlongZ<typename Group::Shape>;
  constexpr std::size_t n = InPlaneOrSpace::n, n_z = AcrossPlane::n;
  const InPlaneOrSpace x(group, 0, cells), y(group, 1, cells);
  const AcrossPlane z(group, 2, cells);
  NodeSums<InPlaneOrSpace, Slopes::derivatives> velocity, increment;
  NodeSums<InPlaneOrSpace, Slopes::moments> change;
  std::array<Vector, n> loss;
  for (std::size_t i = 0; i < n; ++i) {
    Vector field_x = v;
    if constexpr (affine) field_x = multiply_add(x.distance[i], c[0], field_x);
    typename NodeSums<InPlaneOrSpace, Slopes::derivatives>::Rows row_velocity, row_increment;
    typename NodeSums<InPlaneOrSpace, Slopes::moments>::Rows row_change;
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
        const Vector beta =
            relaxation(first, [&](std::size_t m) -> const grid::Node& { return group.stencil[m](i, j, k); });
        const Vector difference = field - first;
        d[k] = group.second(i, j, k);
        velocities[k] = first;
        const Vector relaxed = beta * difference, rest = difference - d[k];
        changed[k] = d[k] - relaxed;
        lost[k] = multiply_add(relaxed, rest + rest, d[k] * d[k]);
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
template <class Group, class Value>
WHIPPLE_INLINE inline ValueAndGradient<Vector> sums_of(const Group& group, const Cells& cells,
                                                       Value&& value) {
  using InPlaneOrSpace = Along<typename Group::Shape>;
  using AcrossPlane = AlongZ<typename Group::Shape>;
  constexpr std::size_t n = InPlaneOrSpace::n, n_z = AcrossPlane::n;
  const InPlaneOrSpace x(group, 0, cells), y(group, 1, cells);
  const AcrossPlane z(group, 2, cells);
  NodeSums<InPlaneOrSpace, Slopes::derivatives> planes;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    typename NodeSums<InPlaneOrSpace, Slopes::derivatives>::Rows rows;
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

/// Sum of lanes 0 to 2, in all lanes.
WHIPPLE_INLINE inline Vector sum_of_three(Vector v) { return lane(v, 0) + lane(v, 1) + lane(v, 2); }

/// a x b in lanes 0 to 2 of every point, 0 in lane 3.
WHIPPLE_INLINE inline Vector cross(Vector a, Vector b) { return turned(a * turned(b) - turned(a) * b); }

WHIPPLE_INLINE inline Vector squared_norm(const std::array<Vector, 3>& columns) {
  return sum_of_three(columns[0] * columns[0] + columns[1] * columns[1] + columns[2] * columns[2]);
}

/// C_p <- C_p (I + dt L)^-1, never growing (equation 4.8): v_p belongs to the new position, so C_p must be
/// carried there. @returns the loss of |C|^2
WHIPPLE_INLINE inline Vector advect_affine_field(std::array<Vector, 3>& c,
                                                 const std::array<Vector, 3>& gradient, double dt) {
  const Vector f0 = of_group([](std::size_t) { return Lanes{1.0, 0.0, 0.0, 0.0}; }) + dt * gradient[0];
  const Vector f1 = of_group([](std::size_t) { return Lanes{0.0, 1.0, 0.0, 0.0}; }) + dt * gradient[1];
  const Vector f2 = of_group([](std::size_t) { return Lanes{0.0, 0.0, 1.0, 0.0}; }) + dt * gradient[2];
  const std::array<Vector, 3> rows = {cross(f1, f2), cross(f2, f0), cross(f0, f1)};  // of the adjugate
  const Vector determinant = sum_of_three(f0 * rows[0]);
  // A deformation that large in a step has no meaningful inverse.
  const auto too_large = determinant <= 0.1;
  const Vector before = squared_norm(c), inverse = 1.0 / determinant;
  std::array<Vector, 3> carried;  // times the determinant
  for (std::size_t a = 0; a < 3; ++a) {
    carried[a] = lane(rows[0], a) * c[0] + lane(rows[1], a) * c[1] + lane(rows[2], a) * c[2];
  }
  const Vector after = squared_norm(carried);
  const Vector cap = root(before / after);  // 0/0 is not less than the inverse
  const Vector scale = cap < inverse ? cap : inverse;
  for (std::size_t a = 0; a < 3; ++a) c[a] = too_large ? c[a] : scale * carried[a];
  return too_large ? Vector{} : before - scale * scale * after;
}

/// Gathers from the nodes: `of` sums over the nodes of a group, of which it reads `Content`; `advance`, if
/// present, computes the new values of the points from the sums.
///
/// Velocity and affine field (4.3), transfer dissipation (4.5).
/// @tparam affine  whether the points carry an affine field; what becomes of it is no other kernel, but a
///                 branch that always goes the same way
template <bool affine>
struct TransferSums {
  using Content = grid::Node;
  using Sum = Moments<Vector>;
  using Result = Advance<Vector>;
  AffineField field;
  double dt;

  template <class Points>
  WHIPPLE_INLINE static Vector velocity(const Points& points, const PointsOfGroup& p) {
    return of_group([&](std::size_t m) { return load_vector(points.velocity[p[m]].data()); });
  }
  template <class Points>
  WHIPPLE_INLINE static std::array<Vector, 3> affine_field(const Points& points, const PointsOfGroup& p) {
    std::array<Vector, 3> c{};
    if constexpr (affine) {
      // Lane 3 is that of the next column, or 0.
      c[0] = of_group([&](std::size_t m) { return load(points.affine_velocity[p[m]].data()); });
      c[1] = of_group([&](std::size_t m) { return load(points.affine_velocity[p[m]].data() + 3); });
      c[2] = of_group([&](std::size_t m) { return load_vector(points.affine_velocity[p[m]].data() + 6); });
    }
    return c;
  }

  template <class Points, class Group>
  WHIPPLE_INLINE Moments<Vector> of(const Points& points, const Group& group, const Cells& cells) const {
    return moments<affine>(group, cells, velocity(points, group.point), affine_field(points, group.point));
  }
  template <class Shape, class Points>
  WHIPPLE_INLINE Advance<Vector> advance(const Points& points, const PointsOfGroup& p,
                                         const Moments<Vector>& sums, double cell_size) const {
    const Vector change = sums.change.value;
    std::array<Vector, 3> c = affine_field(points, p);
    Vector heat = 0.5 * (sums.loss - change * change);
    if constexpr (affine) {
      const double inertia = Shape::second_moment * cell_size * cell_size;  // sum N r r^T in one direction
      Vector per_inertia = of_group([&](std::size_t) { return broadcast(1.0 / inertia); });
      if constexpr (requires { points.unrelaxed; }) {  // some carry no affine field: theirs stays 0
        per_inertia *=
            of_group([&](std::size_t m) { return broadcast(p[m] < points.unrelaxed ? 0.0 : 1.0); });
      }
      for (std::size_t a = 0; a < 3; ++a) {
        const Vector change_of_field = per_inertia * sums.change.gradient[a];
        heat -= 0.5 * change_of_field * sums.change.gradient[a];
        c[a] += change_of_field;
      }
      heat = sum_of_three(heat);
      if (field == AffineField::deformed) {
        heat += 0.5 * inertia * advect_affine_field(c, sums.velocity.gradient, dt);
      }
    } else {
      heat = sum_of_three(heat);
    }
    return {sums.velocity, sums.increment, velocity(points, p) + change, c, heat};
  }
};
/// Value and gradient between the eight nodes of a cell, direction by direction.
/// @tparam Value  Lanes or Both
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

/// New velocity of the grid, and what of it the step brought.
struct UpdateSums {
  using Content = grid::Node;
  template <class Stencil>
  WHIPPLE_INLINE static VelocityUpdate<> between(const grid::PlaceInStencil& place, double per_cell,
                                                 const Stencil& nodes) {
    const auto node = [&](auto... at) WHIPPLE_INLINE { return load_node(nodes(at...)); };
    const ValueAndGradient<Both> sums =
        between_nodes<Both>({spread_both(place.from_first(0)), spread_both(place.from_first(1)),
                             spread_both(place.from_first(2))},
                            spread_both(per_cell), node);
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
    const auto after = [&](auto... node) { return group.first(node...) + group.second(node...); };
    return {sums_of(group, cells, after),
            sums_of(group, cells, [&](auto... node) { return group.second(node...); }).value};
  }
};
/// Sums of the first registers.
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
    return sums_of(group, cells, [&](auto... node) { return group.first(node...); });
  }
};

WHIPPLE_INLINE inline ValueAndGradient<> part(const ValueAndGradient<Vector>& sums, std::size_t i) {
  return {part(sums.value, i),
          {part(sums.gradient[0], i), part(sums.gradient[1], i), part(sums.gradient[2], i)}};
}
WHIPPLE_INLINE inline Advance<> part(const Advance<Vector>& sums, std::size_t i) {
  return {part(sums.grid_velocity, i),
          part(sums.increment, i),
          part(sums.velocity, i),
          {part(sums.affine[0], i), part(sums.affine[1], i), part(sums.affine[2], i)},
          part(sums.heat, i)};
}
WHIPPLE_INLINE inline VelocityUpdate<> part(const VelocityUpdate<Vector>& sums, std::size_t i) {
  return {part(sums.after, i), part(sums.increment, i)};
}
